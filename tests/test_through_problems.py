"""Motions through the nodes from problem files: certified, and as quick as stopping, whatever is asked besides."""

import json
from pathlib import Path

import numpy as np
import pytest

from timelaw.certificate import certify
from timelaw.errors import InfeasibleError, InputError
from timelaw.law_file.document import from_document, to_document
from timelaw.numerics.quaternion import rotation_between
from timelaw.pipeline import design_problem
from timelaw.problem.load import check_problem
from timelaw.problem.source import read
from timelaw.report.summary import measure_all_efforts
from timelaw.reproduce.random_sets import KINDS, draw_problem
from timelaw.time_law.baselines import time_double_s

LIMITS = "velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3"
LIST = "[[1,0,0,0],[0.8,0.6,0,0],[0.7,0.1,0.7,0.1],[0.5,-0.5,0.5,0.5]]"


def design_text(
    more="", route=f"orientations: {{list: {LIST}}}", limits=LIMITS, motion="{kind: through, pieces: 1}"
):
    text = f"""timelaw: 1
name: passing
route: {{{route}}}
limits: {{{limits}}}
motion: {motion}
baselines: []
{more}
"""
    source = read(text, "passing.yaml")
    return design_problem(Path("passing.yaml"), check_problem(source), source)


def check(design, *, passed=True):
    """Certified from its own file, at every node at its time, as quick as stopping."""
    law = design.optimised.law
    assert design.optimised.certificate.findings() == []
    again = from_document(json.loads(json.dumps(to_document(law))))
    assert certify(again).digest == design.optimised.certificate.digest
    ends = [design.route.legs[0].start, *(leg.end for leg in design.route.legs)]
    times = [s.start_time for s in law.segments if s.moves] + [law.legs[-1].end_time]
    for time, node in zip(times, ends, strict=True):
        assert min(rotation_between(law(time), sign * node) for sign in (1, -1)) < 1e-9
    assert bool(design.through.passed) == passed
    return law


def test_passing_is_quicker_than_stopping():
    design = design_text()
    law = check(design)
    assert law.duration < 0.9 * time_double_s(design.route, design.requirements).duration
    assert np.linalg.norm(law(law.times[1], 1)) > 0.1


@pytest.mark.parametrize(
    ("more", "limits"),
    [
        ("nodes: {continuity: 1}", "velocity: 60 deg/s, acceleration: 120 deg/s^2"),
        ("nodes: {continuity: 3}", f"{LIMITS}, snap: 9000 deg/s^4"),
        ("", "velocity: [60 deg/s, 50 deg/s, 40 deg/s], acceleration: 120 deg/s^2, jerk: 600 deg/s^3"),
        ("body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2]}", f"{LIMITS}, torque: 15 N*m"),
        (
            "body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2], actuator: wheels, "
            "momentum: [0.2 N*m*s, 0 N*m*s, -0.3 N*m*s]}",
            f"{LIMITS}, torque: 15 N*m, momentum: 9 N*m*s",
        ),
        ("nodes: {at: {2: {limits: {velocity: 20 deg/s}}}}", LIMITS),
        ("segments: {2-3: {limits: {acceleration: 30 deg/s^2}}}", LIMITS),
    ],
    ids=["C1", "C3 and snap", "axes", "torque", "wheels", "slow node", "slow leg"],
)
def test_under_every_kind_of_limit(more, limits):
    check(design_text(more, limits=limits, motion="through"))


def test_stops_and_dwells_cut_the_way():
    law = check(design_text("nodes: {at: {2: {dwell: 1 s}}}"))
    assert [segment.kind for segment in law.segments] == ["arc", "dwell", "rational", "rational"]
    law = check(design_text("nodes: {dwell: 0.5 s}"), passed=False)
    assert {segment.kind for segment in law.segments} == {"arc", "dwell"}


@pytest.mark.campaign
@pytest.mark.parametrize(("degrees", "time"), [(10, 24.4), (5, 25.1), (2, 26.0), (1, 26.5)])
def test_a_tour_near_its_arcs_passes_them_all(degrees, time):
    """By the whole ladder, proved, and no law that stops instead."""
    route = "orientations: {lattice: 24-cell}, tour: paper"
    design = design_text(route=route, motion=f"{{kind: through, deviation: {degrees} deg}}")
    assert check(design).duration <= time


@pytest.mark.parametrize("degrees", [20, 3])
def test_deviation_is_proved(degrees):
    design = design_text(motion=f"{{kind: through, pieces: 1, deviation: {degrees} deg}}")
    check(design)
    (found,) = (c for c in design.optimised.certificate.limits if c.limit == "deviation")
    assert found.upper <= np.radians(degrees) * (1 + 1e-12)
    law = design.optimised.law
    for leg, segment in zip(design.route.legs, law.segments, strict=True):
        fine = np.linspace(0, 1, 2001)[:, None]
        half = np.arccos(np.clip(leg.start @ leg.end, -1, 1))
        way = (np.sin((1 - fine) * half) * leg.start + np.sin(fine * half) * leg.end) / np.sin(half)
        there = law(np.linspace(segment.start_time, segment.end_time, 101))
        nearest = 2 * np.arccos(np.clip(np.max(np.abs(there @ way.T), axis=1), -1, 1))
        assert np.max(nearest) <= found.upper + 1e-6


@pytest.mark.parametrize(
    ("more", "time"),
    [
        ("nodes: {at: {3: {time: 4 s}}}", None),
        ("segments: {2-3: {duration: 2.5 s}}", None),
        ("objective: {minimise: jerk, total_time: 8 s}", 8.0),
        ("objective: {minimise: energy, total_time: 1.3 x minimum}", None),
        ("objective: {minimise: peak, total_time: 8 s}", 8.0),
        ("objective: {minimise: jerk, weight: 0.3}", None),
        ("nodes: {start: {velocity: 20 deg/s}}", None),
        ("nodes: {start: {velocity: [20 deg/s, -10 deg/s, 5 deg/s]}, end: {velocity: 10 deg/s}}", None),
    ],
)
def test_what_is_given_is_kept(more, time):
    design = design_text(more)
    law = check(design)
    if time is not None:
        assert law.duration == pytest.approx(time, rel=1e-12)
    if "time: 4 s" in more:
        assert law.times[2] == pytest.approx(4, rel=1e-12)
    if "duration" in more:
        assert law.segments[1].duration == pytest.approx(2.5, rel=1e-12)
    if "[20 deg/s" in more:
        np.testing.assert_allclose(np.degrees(law(0.0, 1)), [20, -10, 5], rtol=1e-8)
        assert np.degrees(np.linalg.norm(law(law.duration, 1))) == pytest.approx(10, rel=1e-8)


@pytest.mark.parametrize("what", ["jerk", "energy", "peak"])
def test_an_objective_is_less_than_that_of_stopping(what):
    through = design_text(f"objective: {{minimise: {what}, total_time: 9 s}}").through
    assert through.spent < 0.9 * through.stopping_spent


def test_efforts_of_a_sweep_are_those_of_the_motion():
    """As the search counts them, and by sums over samples."""
    body = "body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2]}"
    for what in ("jerk", "torque"):
        design = design_text(f"{body}\nobjective: {{minimise: {what}, total_time: 9 s}}")
        found = measure_all_efforts(design)
        assert found[what] == pytest.approx(design.through.spent, rel=1e-6)
    t = (np.arange(40000) + 0.5) * (9 / 40000)
    alpha = design.optimised.law(t, 2)
    assert found["energy"] == pytest.approx(float(np.sum(alpha**2)) * 9 / 40000, rel=1e-5)


def test_a_closed_tour_goes_round():
    route = f"orientations: {{list: {LIST}}}, closed: true"
    design = design_text("nodes: {start: periodic}", route)
    law = check(design)
    assert law.periodic
    for order in (1, 2):
        np.testing.assert_allclose(law(0.0, order), law(law.duration, order, "left"), atol=1e-9)
    assert law.duration < check(design_text("", route)).duration
    document = to_document(law)
    document["periodic"] = False
    assert certify(from_document(document)).findings() != []


def test_the_same_orientation_twice_in_a_row_is_one_node():
    twice = "[[1,0,0,0],[0.8,0.6,0,0],[-0.8,-0.6,0,0],[0.7,0.1,0.7,0.1]]"
    route = f"orientations: {{list: {twice}}}, tour: [1, 2, 3, 4]"
    law = check(design_text("nodes: {at: {3: {dwell: 1 s}}}", route), passed=False)
    assert [segment.kind for segment in law.segments] == ["arc", "dwell", "arc"]
    with pytest.raises(InputError, match="one node; give its rules once"):
        design_text("nodes: {at: {2: {stop: true}, 3: {dwell: 1 s}}}", route)


def test_the_same_orientation_again_later_is_passed_again():
    route = f"orientations: {{list: {LIST}}}, tour: [1, 2, 3, 2, 4]"
    law = check(design_text("", route))
    assert np.linalg.norm(law(law.times[3], 1)) > 0


@pytest.mark.parametrize(
    ("more", "motion", "message"),
    [
        ("nodes: {continuity: 4}", "through", "at most 3"),
        ("", "{kind: through, degree: 4}", "degree"),
        ("nodes: {continuity: 3}", "{kind: through, degree: 7}", "needs 8 or more"),
        ("", "{kind: arcs, pieces: 2}", "belongs to"),
        ("", "around", "allowed: arcs, through"),
        ("", "{kind: through, deviation: 5}", "deviation"),
        ("nodes: {start: periodic}", "through", "closed"),
        ("nodes: {start: {velocity: [1 deg/s, 0, 0]}}", "arcs", "body axes"),
        ("nodes: {start: {velocity: [90 deg/s, 0, 0]}}", "through", "1.5 times as much"),
    ],
)
def test_what_cannot_be_is_refused_with_its_reason(more, motion, message):
    with pytest.raises(InputError, match=message):
        design_text(more, motion=motion)


def test_times_that_nothing_keeps_are_refused_at_their_key():
    with pytest.raises(InfeasibleError, match=r"nodes\.at\.3\.time"):
        design_text("nodes: {at: {3: {time: 1 s}}}")


@pytest.mark.parametrize("number", range(len(KINDS)))
def test_random_sets_of_every_kind(number):
    _, data = draw_problem(3, number)
    data["route"]["orientations"]["list"] = data["route"]["orientations"]["list"][:8]
    data["motion"] = {"kind": "through", "pieces": 1}
    source = read(json.dumps(data), "set.yaml")
    design = design_problem(Path("set.yaml"), check_problem(source), source)
    assert design.optimised.certificate.findings() == []
    stopping = time_double_s(design.route, design.requirements).duration
    assert design.optimised.law.duration <= stopping * (1 + 1e-9)
