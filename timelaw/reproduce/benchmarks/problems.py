"""Problems that are measured: lattices, random routes, single legs; laid out and designed."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from timelaw.easing.family import Family
from timelaw.limits import Demand, drop_implied, list_rows, make_limits
from timelaw.nlp import RunProblem
from timelaw.numerics.array import Array
from timelaw.pipeline import Design, Layout, design_layout, lay_out_problem
from timelaw.problem.load import check_problem
from timelaw.problem.source import read

LIMITS = {"velocity": 60.0, "acceleration": 120.0, "jerk": 600.0}  # deg, s
POLYNOMIAL = {"basis": "polynomial", "degree": 9}
SPLINE = {"basis": "spline", "degree": 4, "intervals": 50}
LATTICES = {11: ("24-cell", "paper"), 59: ("600-cell", "shortest"), 299: ("120-cell", "shortest")}  # by legs
SEED = 20170112


def make_data(route: Mapping[str, Any], **others: Any) -> dict[str, Any]:
    """The data of a problem file under the limits of this room."""
    units = {"velocity": "deg/s", "acceleration": "deg/s^2", "jerk": "deg/s^3"}
    limits = {name: f"{value} {units[name]}" for name, value in LIMITS.items()}
    return {
        "timelaw": 1,
        "name": "measured",
        "route": dict(route),
        "limits": limits,
        "baselines": [],
        **others,
    }


def make_lattice_data(legs: int, **others: Any) -> dict[str, Any]:
    """That of a lattice with so many legs."""
    lattice, tour = LATTICES[legs]
    return make_data({"orientations": {"lattice": lattice}, "tour": tour}, **others)


def list_route(nodes: Array) -> dict[str, Any]:
    """A route through nodes (n, 4) in their order."""
    return {"orientations": {"list": nodes.tolist(), "precision": "1e-9 deg"}, "tour": "given"}


def draw_nodes(count: int) -> Array:
    """Random orientations (n, 4), the same every time, each next one the nearer of ±q."""
    nodes = np.random.default_rng([SEED, count]).normal(size=(count, 4))
    return align_signs(nodes / np.linalg.norm(nodes, axis=1)[:, None])


def align_signs(nodes: Array) -> Array:
    """The same orientations, each next one the nearer of ±q."""
    turned = np.sum(nodes[1:] * nodes[:-1], axis=1) < 0
    signs = np.where(np.cumsum(np.append(False, turned)) % 2, -1.0, 1.0)
    return nodes * signs[:, None]


def draw_runs(count: int, family: Family) -> list[RunProblem]:
    """Runs of one leg, of random angles [rad], the same every time, under the limits of this room."""
    limits = make_limits({name: float(np.radians(value)) for name, value in LIMITS.items()})
    rows = drop_implied(list_rows(limits, np.array([0.0, 0.0, 1.0])))
    angles = np.random.default_rng([SEED, 1]).uniform(0.3, np.pi, count)
    return [RunProblem((Demand(float(angle), rows),), family) for angle in angles]


def lay_out_data(data: Mapping[str, Any]) -> Layout:
    """What a problem fixes before any time is chosen."""
    source = read(json.dumps(data), "<measured>")
    return lay_out_problem(Path("measured.yaml"), check_problem(source), source)


def design_data(data: Mapping[str, Any]) -> Design:
    """The design of a problem's data."""
    return design_layout(lay_out_data(data))


def tell_failure(error: Exception, columns: int) -> list[str]:
    """Cells that say in the first of them what went wrong."""
    return [f"failed: {str(error).splitlines()[0]}", *[""] * (columns - 1)]


def take_first(quick: bool, sizes: Sequence[int], count: int) -> Sequence[int]:
    """All sizes, or the first of them for a quick run."""
    return sizes[:count] if quick else sizes
