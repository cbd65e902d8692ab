"""The time that no law beats: legs of a run that differ, and motions that begin or end at speed."""

from dataclasses import replace
from math import inf, isinf, sqrt

import numpy as np
import pytest

from tests.cases import demand, demands
from timelaw import design
from timelaw.least_time.physical_limit import run_limit
from timelaw.pipeline import lay_out
from timelaw.report import list_law_rows
from timelaw.report.outcome import describe_outcome, measure_gain
from timelaw.requirements.route_limit import find_route_limit

INERTIA = np.diag([12.0, 10.0, 8.0])


def march(angle, w, a, start, end, steps=200_000):
    """Least time over an angle by marching in v²: as hard as a allows from both ends, and no faster than w."""
    s = np.linspace(0, angle, steps + 1)
    v = np.sqrt(np.minimum(np.minimum(start**2 + 2 * a * s, end**2 + 2 * a * (angle - s)), w * w))
    return float(np.sum(2 * np.diff(s) / (v[1:] + v[:-1])))


@pytest.mark.parametrize("seed", range(30))
def test_between_two_speeds_it_is_the_least_time_under_velocity_and_acceleration(seed):
    rng = np.random.default_rng(seed)
    w, a = 10.0 ** rng.uniform(-2, 2, 2)
    angle = 10.0 ** rng.uniform(-1, 1) * w * w / a
    start, end = (min(w, sqrt(2 * a * angle / 2)) * rng.uniform(0.01, 0.99) for _ in range(2))
    limits = {"velocity": w, "acceleration": a}
    least = run_limit(demands((angle / 3, 2 * angle / 3), limits), (start, end))
    assert least == pytest.approx(march(angle, w, a, start, end), rel=1e-4)
    # an unknown speed at the start: the best of them
    tried = [run_limit(demands((angle,), limits), (v, end)) for v in np.linspace(0, w, 50)]
    unknown = run_limit(demands((angle,), limits), (inf, end))
    assert unknown <= min(tried) * (1 + 1e-12)
    assert unknown >= min(tried) * 0.97
    # a jerk limit makes no law faster, and a start at rest but for an acceleration is no rest
    assert run_limit(demands((angle,), {**limits, "jerk": 1e-3 * a}), (start, end)) == pytest.approx(least)
    at_rest = run_limit(demands((angle,), {**limits, "jerk": 1e-3 * a}), (0.0, 0.0))
    assert at_rest == pytest.approx(run_limit(demands((angle,), limits)))


def test_backwards_at_the_start_takes_longer():
    """v₀/a to come to rest, and v₀²/2a to go again."""
    least = run_limit(demands((1.0,), {"acceleration": 2.0}), (-0.5, 0.0))
    assert least == pytest.approx(0.25 + 2 * sqrt((1.0 + 0.0625) / 2.0), rel=1e-12)


@pytest.mark.parametrize("other", [3.0, 6.0 * (1 + 1e-9), (4.0, 3.0, 5.0)])
def test_legs_that_differ_in_torque_count_as_the_loosest(other):
    one, two = (demand(1.0, {"torque": torque}, inertia=INERTIA) for torque in (6.0, other))
    fast, slow = (run_limit((replace(leg, angle=2.0),)) for leg in (one, two))
    both = run_limit((one, two))
    assert 0.98 * min(fast, slow) <= both <= min(fast, slow) * (1 + 1e-6)
    assert both == pytest.approx(run_limit((two, one)), rel=1e-9)


def test_orientations_typed_with_eight_digits_under_wheels_with_net_momentum(tmp_path):
    """Legs about one axis whose rows differ in the ninth digit are measured as well as equal ones."""
    half = np.radians(np.array([0, 20, 40, 60, 80]) / 2)
    axis = np.array([2.0, 3.0, 6.0]) / 7
    exact = [[float(np.cos(h)), *(float(np.sin(h) * a) for a in axis)] for h in half]
    limits = []
    for typed in (exact, [[round(c, 8) for c in q] for q in exact]):
        path = tmp_path / "p.yaml"
        path.write_text(
            f"timelaw: 1\nname: p\nroute: {{orientations: {{list: {typed}}}, tour: given}}\n"
            "body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2], actuator: wheels, "
            "momentum: [0.1 N*m*s, 0 N*m*s, 0.2 N*m*s]}\n"
            "limits: {torque: [0.4 N*m, 0.3 N*m, 0.5 N*m]}\n"
            "nodes: {continuity: 1}"
        )
        layout = lay_out(path)
        assert layout.route.straight_nodes == 3
        limits.append(find_route_limit(layout.route, layout.requirements))
    assert limits[1] == pytest.approx(limits[0], rel=1e-6)
    assert limits[0] > 1


def test_a_motion_of_which_no_limit_is_known_says_so(tmp_path):
    """Jerk alone bounds no motion that begins at speed."""
    path = tmp_path / "p.yaml"
    path.write_text(
        "timelaw: 1\nname: p\nroute: {orientations: {list: [[1, 0, 0, 0], [0, 1, 0, 0]]}}\n"
        "limits: {jerk: 60 deg/s^3}\nnodes: {start: {velocity: 5 deg/s}}\n"
        "easing: {basis: polynomial, degree: 9}\n"
    )
    designed = design(path)
    rows = list_law_rows(designed)
    assert isinf(rows[0].to_limit)
    assert rows[0].to_dict()["to_limit"] is None
    assert describe_outcome(designed, rows)[0].endswith("no physical limit of it is known.")


def test_the_quintic_is_no_measure_of_a_motion_that_begins_at_speed(tmp_path):
    path = tmp_path / "p.yaml"
    path.write_text(
        "timelaw: 1\nname: p\nroute: {orientations: {list: [[1, 0, 0, 0], [0, 1, 0, 0]]}}\n"
        "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}\n"
        "nodes: {start: {velocity: 5 deg/s}}\nobjective: {minimise: jerk, total_time: 8 s}\n"
        "easing: {basis: polynomial, degree: 9}\n"
    )
    designed = design(path)
    gain = measure_gain(designed)
    assert gain.reference is None
    assert gain.part is None
    assert "is no measure of a motion that does not" in describe_outcome(designed, list_law_rows(designed))[1]
