"""Fastest tours: travel times against the scalar closed forms, all permutations of small sets, bounds, runs."""

from itertools import pairwise, permutations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import problem, random_limits, unit_quaternions
from timelaw.errors import InputError
from timelaw.least_time import double_s
from timelaw.least_time.physical_limit import run_limit
from timelaw.limits import Demand, drop_implied, list_rows, make_limits
from timelaw.limits.body import RigidBody
from timelaw.orientations.lattices import make_lattice
from timelaw.pipeline import lay_out
from timelaw.tours.ends import Ends
from timelaw.tours.fastest import find_fastest, sum_times
from timelaw.tours.travel_times import TravelTimes

LIMITS = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}
BY_AXIS = {"velocity": (1.0, 0.5, 2.0), "acceleration": (2.0, 2.0, 1.0), "jerk": 10.0}


def travel_times(q, limits=None, inertia=None, passable=None):
    return TravelTimes(
        q,
        make_limits(limits or LIMITS, None if inertia is None else RigidBody(inertia)),
        range(len(q)) if passable is None else passable,
    )


def test_many_times_at_once_are_those_one_by_one():
    rng = np.random.default_rng(3)
    cases = [(float(10 ** rng.uniform(-2, 0.5)), *random_limits(rng).values()) for _ in range(300)]
    cases += [(a, w, c, np.inf) for a, w, c, _ in cases[:50]] + [
        (a, np.inf, c, j) for a, _, c, j in cases[:50]
    ]
    cases += [(a, np.inf, np.inf, j) for a, _, _, j in cases[:50]] + [
        (a, w, np.inf, j) for a, w, _, j in cases[:50]
    ]
    cases += [(a, w, np.inf, np.inf) for a, w, _, _ in cases[:20]] + [
        (a, np.inf, c, np.inf) for a, _, c, _ in cases[:20]
    ]
    together = double_s.double_s_times(*(np.array(column) for column in zip(*cases, strict=True)))
    np.testing.assert_allclose(together, [double_s.double_s_time(*case) for case in cases], rtol=1e-12)


@pytest.mark.parametrize(
    "limits", [LIMITS, BY_AXIS, {**BY_AXIS, "momentum": (3.0, 1.0, 2.0)}, {"velocity": 1.0, "momentum": 2.0}]
)
def test_travel_times_agree_with_the_rows_of_each_leg(limits):
    q, inertia = unit_quaternions(np.random.default_rng(4), 12), np.diag([2.0, 3.0, 4.0])
    times = travel_times(q, limits, inertia).legs
    for i, j in permutations(range(12), 2):
        turn = (
            Rotation.from_quat(q[i], scalar_first=True).inv() * Rotation.from_quat(q[j], scalar_first=True)
        ).as_rotvec()
        angle = np.linalg.norm(turn)
        rows = drop_implied(list_rows(make_limits(limits, RigidBody(inertia)), turn / angle))
        assert times[i, j] == pytest.approx(run_limit([Demand(angle, rows)]), rel=1e-9)


def slow_duration(q, order, limits):
    """Least time of an order, its runs found by SciPy's rotations, norm limits only."""
    rotations = Rotation.from_quat(q[list(order)], scalar_first=True)
    turns = (rotations[:-1].inv() * rotations[1:]).as_rotvec()
    sizes = np.linalg.norm(turns, axis=1)
    total, run = 0.0, sizes[0]
    for k in range(1, len(turns)):
        straight = np.linalg.norm(turns[k] / sizes[k] - turns[k - 1] / sizes[k - 1]) < 1e-7
        if not straight:
            total += double_s.double_s_time(run, *limits.values())
        run = run + sizes[k] if straight else sizes[k]
    return total + double_s.double_s_time(run, *limits.values())


def raster():
    """Seven orientations, three and four of them about one axis each."""
    angles = [(0, 0), (20, 0), (50, 0), (0, 30), (20, 30), (60, 30), (90, 30)]
    return Rotation.from_euler("ZY", angles, degrees=True).as_quat(scalar_first=True)


@pytest.mark.parametrize(("start", "end"), [(None, None), (2, None), (0, 6)])
@pytest.mark.parametrize("points", ["raster", "random", "some of the 24-cell"])
def test_small_sets_by_all_permutations(points, start, end):
    q = {
        "raster": raster(),
        "random": unit_quaternions(np.random.default_rng(9), 7),
        "some of the 24-cell": make_lattice("24-cell")[4:11],
    }[points]
    orders = [o for o in permutations(range(7)) if start in (None, o[0]) and end in (None, o[-1])]
    best = min(slow_duration(q, order, LIMITS) for order in orders)
    found = find_fastest(travel_times(q), Ends(False, start, end))
    (merit,) = found.merits
    assert merit.value == pytest.approx(best, rel=1e-9)
    assert merit.is_best
    assert slow_duration(q, found.order, LIMITS) == pytest.approx(best, rel=1e-9)


def test_a_closed_tour_may_rest_anywhere():
    q = make_lattice("24-cell")[[0, 4, 8, 5, 11, 7]]
    found = find_fastest(travel_times(q), Ends(True))
    best = min(slow_duration(q, (*order, order[0]), LIMITS) for order in permutations(range(6)))
    assert found.merits[0].value == pytest.approx(best, rel=1e-9)


def test_the_24_cell():
    found = find_fastest(
        travel_times(
            make_lattice("24-cell"), {k: np.radians(v) for k, v in zip(LIMITS, (60, 120, 600), strict=True)}
        ),
        Ends(),
    )
    assert found.merits[0].value == pytest.approx(26.2, rel=1e-9)
    assert found.merits[0].is_best


def test_nodes_that_must_be_rested_at_are_no_part_of_a_run():
    q = raster()
    free, resting = (
        find_fastest(travel_times(q, passable=p), Ends()).merits[0].value for p in (range(7), ())
    )
    assert resting > free
    assert resting == pytest.approx(find_fastest(travel_times(q, passable=[0]), Ends()).merits[0].value)


@pytest.mark.parametrize("points", ["random", "grid"])
def test_larger_sets_have_a_bound_that_holds(points):
    """Any order, shuffled or searched, takes at least the bound."""
    rng = np.random.default_rng(11)
    grid = [(a, b) for a in range(0, 100, 20) for b in range(0, 80, 20)]
    q = (
        unit_quaternions(rng, 20)
        if points == "random"
        else Rotation.from_euler("ZY", grid, degrees=True).as_quat(scalar_first=True)
    )
    timed = travel_times(q)
    found = find_fastest(timed, Ends())
    (merit,) = found.merits
    assert sorted(found.order) == list(range(20))
    assert slow_duration(q, found.order, LIMITS) == pytest.approx(merit.value, rel=1e-9)
    assert 0 < merit.bound <= merit.value
    assert merit.bound <= min(slow_duration(q, rng.permutation(20), LIMITS) for _ in range(200))
    rows = tuple(range(20))
    assert merit.value <= sum_times(timed, rows, closed=False) + 1e-9


@pytest.mark.campaign
def test_the_bound_is_below_the_exact_time_where_both_are_known(monkeypatch):
    from timelaw.tours import fastest as module

    for seed in range(2):
        q = np.concatenate([raster(), unit_quaternions(np.random.default_rng(seed), 2)])
        for limits in (LIMITS, BY_AXIS):
            exact = find_fastest(travel_times(q, limits), Ends()).merits[0].value
            with monkeypatch.context() as patch:
                patch.setattr(module, "MOST_NODES", 0)
                searched = find_fastest(travel_times(q, limits), Ends()).merits[0]
                patch.setattr(TravelTimes, "most_runs", 0)
                coarse = find_fastest(travel_times(q, limits), Ends()).merits[0]
            assert coarse.bound <= searched.bound * (1 + 1e-9)
            assert searched.bound <= exact * (1 + 1e-9)
            assert searched.value >= exact * (1 - 1e-9)
            assert searched.value <= 1.05 * exact


def test_torque_is_timed_by_the_phase_plane():
    q, inertia = unit_quaternions(np.random.default_rng(2), 4), np.diag([12.0, 10.0, 8.0])
    limits = {"velocity": 0.1, "torque": (0.2, 0.2, 0.1)}
    timed = travel_times(q, limits, inertia)
    found = find_fastest(timed, Ends())
    assert found.merits[0].value == pytest.approx(
        min(sum(timed.legs[a, b] for a, b in pairwise(o)) for o in permutations(range(4))), rel=1e-12
    )
    with pytest.raises(InputError, match="with a torque limit, 60 orientations at most can be timed, not 61"):
        _ = travel_times(unit_quaternions(np.random.default_rng(2), 61), limits, inertia).legs


def test_a_leg_without_a_limit():
    q = Rotation.from_euler("ZYX", [(0, 0, 0), (30, 0, 0), (0, 40, 0)], degrees=True).as_quat(
        scalar_first=True
    )
    limits = make_limits({"torque": (1.0, 1.0, 1.0)}, RigidBody(np.eye(3)))
    assert np.all(np.isfinite(TravelTimes(q, limits, range(3)).legs))


def problem_file(tmp_path, route, more=""):
    path = tmp_path / "p.yaml"
    path.write_text(
        f"timelaw: 1\nname: p\nroute: {{{route}}}\n"
        f"limits: {{velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}}\n{more}"
    )
    return path


def time_of(path):
    return next(merit for merit in lay_out(path).tour.merits if merit.name == "time").value


def test_stops_and_dwells_of_the_problem_count(tmp_path):
    route = "orientations: {lattice: 24-cell}, tour: fastest"
    dwell = "nodes: {dwell: 0.5 s}\n"
    but_two = "nodes: {dwell: 0.5 s, at: {5: {dwell: 0 s}, 6: {dwell: 0 s}}}\n"
    one = "nodes: {at: {5: {stop: true}}}\n"
    for more, expected in (("", 26.2), (dwell, 29.7 + 6), (but_two, 29.7 - 2 * 0.7 + 5), (one, 26.2)):
        assert time_of(problem_file(tmp_path, route, more)) == pytest.approx(expected)


def test_the_problem_model_knows_the_same_tours():
    from timelaw.tours.tour import TOURS

    for name in TOURS:
        assert problem(f"route: {{orientations: {{lattice: 24-cell}}, tour: {name}}}").route.tour == name
