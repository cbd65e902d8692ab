"""Certified laws that are altered: small designs of all kinds, laws of curves and of paths, and the committed results."""

import json
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tests.exact.curve_laws import list_curve_laws
from tests.exact.path_laws import list_path_laws
from timelaw import design
from timelaw.export import format_law

RESULTS = Path(__file__).parent.parent.parent / "results"
RATES = "velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3"
THREE = "[[0, 0, 0], [40, 0, 0], [90, 0, 0], [90, 60, 0]]"
INERTIA = "[[12 kg*m^2, 1 kg*m^2, -0.5 kg*m^2], [1 kg*m^2, 10 kg*m^2, 0.7 kg*m^2], [-0.5 kg*m^2, 0.7 kg*m^2, 8 kg*m^2]]"
WHEELS = f"body: {{inertia: {INERTIA}, actuator: wheels, momentum: [0.2 N*m*s, -0.3 N*m*s, 0.6 N*m*s]}}"

NINE = "easing: {basis: polynomial, degree: 9}"


def _text(places: str, limits: str, *lines: str) -> str:
    route = f"route: {{orientations: {{list: {places}, as: euler, sequence: XYZ, unit: deg}}, tour: given}}"
    return "\n".join(["timelaw: 1", "name: altered", route, f"limits: {{{limits}}}", *lines])


PROBLEMS = {
    "polynomial": _text(THREE, RATES, NINE),
    "spline": _text(
        THREE, f"{RATES}, snap: 9000 deg/s^4", "easing: {basis: spline, degree: 5, intervals: 12}",
        "nodes: {continuity: 3, dwell: 0.5 s}",
    ),
    "cubic spline": _text(THREE, RATES, "easing: {basis: spline, degree: 3, intervals: 8}"),
    "double-s": _text(THREE, RATES, "easing: {basis: double-s}"),
    "by axis": _text(
        "[[0, 0, 0], [30, 20, 0], [30, 20, 50]]",
        "velocity: [60 deg/s, 50 deg/s, 40 deg/s], acceleration: [120 deg/s^2, 90 deg/s^2, 200 deg/s^2], "
        "jerk: [600 deg/s^3, 700 deg/s^3, 900 deg/s^3]",
        "nodes: {dwell: 0.4 s}", NINE, "segments: {1-2: {limits: {velocity: 20 deg/s}}}",
    ),
    "torque": _text(
        THREE, "torque: 4 N*m, momentum: 8 N*m*s, jerk: 90 deg/s^3", f"body: {{inertia: {INERTIA}}}", NINE
    ),
    "torque by axis": _text(
        THREE, "torque: [4 N*m, 5 N*m, 3 N*m], jerk: 90 deg/s^3", f"body: {{inertia: {INERTIA}}}", NINE,
    ),
    "wheels": _text(
        THREE, "torque: [0.4 N*m, 0.3 N*m, 0.5 N*m], momentum: [4 N*m*s, 3 N*m*s, 3 N*m*s], jerk: 20 deg/s^3",
        WHEELS, "nodes: {dwell: 3 s}", NINE,
    ),
    "wheels by norm": _text(THREE, "torque: 0.4 N*m, momentum: 4 N*m*s, jerk: 20 deg/s^3", WHEELS, NINE),
    "moving ends": _text(
        "[[0, 0, 0], [90, 0, 0], [90, 80, 0]]", RATES,
        "nodes: {start: {velocity: 30 deg/s}, end: {velocity: 20 deg/s}}", NINE,
    ),
    "slow leg": _text(THREE, RATES, NINE, "segments: {1-2: {limits: {velocity: 10 deg/s}}}", "nodes: {at: {2: {stop: true}}}"),
}  # fmt: skip


@cache
def make_law(name: str) -> dict[str, Any]:
    """The law document of one problem, as `timelaw design` writes it."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "problem.yaml"
        path.write_text(PROBLEMS[name])
        done = design(path).optimised
    return json.loads(format_law(done.law, done.certificate, {}))


@cache
def read_results() -> dict[str, dict[str, Any]]:
    """The committed laws, by name."""
    return {path.parent.name: json.loads(path.read_text()) for path in sorted(RESULTS.glob("*/law.json"))}


def list_designs(names: tuple[str, ...] = tuple(PROBLEMS)) -> dict[str, dict[str, Any]]:
    """Small designs of all kinds, by name."""
    return {name: make_law(name) for name in names}


GROUPS = {"arcs": list_designs, "curves": list_curve_laws, "paths": list_path_laws, "results": read_results}


def list_laws(names: tuple[str, ...] = tuple(PROBLEMS)) -> dict[str, dict[str, Any]]:
    """Laws to alter, by name: those designs, and all of the other groups."""
    others = (make() for group, make in GROUPS.items() if group != "arcs")
    return {name: law for laws in (list_designs(names), *others) for name, law in laws.items()}
