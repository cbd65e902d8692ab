"""Least times of many single legs at once, against a linear program that shares no code, and the nonlinear one."""

import numpy as np
import pytest

from tests.cases import AXIS, demand, random_limits
from tests.oracles import LinearProgram
from tests.test_architecture import loaded
from timelaw.easing.family import PolynomialFamily
from timelaw.easing.polynomial_basis import PolynomialBasis
from timelaw.easing.smoothstep import time_legs
from timelaw.easing.time_scaling import used_fraction
from timelaw.least_time.double_s import double_s_time
from timelaw.limits.bounds import least_quotient
from timelaw.nlp import RunProblem, Status, single_runs
from timelaw.nlp.single_runs import solve_distinct, solve_run, solve_runs
from timelaw.single_legs import least_times
from timelaw.single_legs.least_times import are_rates_limited, solve_legs
from timelaw.time_limit import limit_time

ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3, "snap": 4}
PROVED = 1e-7  # relative: how far above its own lower bound a law may be
SLOWER = 1e-5  # relative: how much slower than the nonlinear program


def random_demands(seed, count, **others):
    """Legs under three limits of six decades each."""
    rng = np.random.default_rng(seed)
    return [demand(10 ** rng.uniform(-1.5, 0.49), random_limits(rng), **others) for _ in range(count)]


def double_s(leg):
    return double_s_time(leg.angle, *(row.bound for row in leg.rows))


@pytest.mark.parametrize(
    ("degree", "continuity", "limits"),
    [
        (9, 2, {"velocity": 0.02, "acceleration": 4.0, "jerk": 90.0}),
        (11, 2, {"velocity": 9.0, "acceleration": 0.1, "jerk": 50.0}),
        (13, 3, {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0, "snap": 90.0}),
    ],
)
def test_least_times_are_those_of_a_linear_program_that_knows_no_symmetry(degree, continuity, limits):
    (found,) = solve_legs([demand(2.0, limits)], PolynomialBasis(degree, continuity))
    bounds = {ORDERS[name]: bound for name, bound in limits.items()}
    lower, upper = LinearProgram(degree, continuity, (2.0,), bounds).solve()
    assert lower * (1 - 2e-6) <= found.timing.duration <= upper * (1 + 2e-6)


@pytest.mark.parametrize(("degree", "continuity"), [(5, 2), (7, 3), (9, 2), (10, 2), (31, 2)])
def test_every_leg_is_solved_within_its_limits_and_none_beats_physics(degree, continuity):
    legs = random_demands(degree, 40)
    found = solve_legs(legs, PolynomialBasis(degree, continuity))
    slow = time_legs(legs, continuity)
    for leg, fastest, smoothstep in zip(legs, found, slow, strict=True):
        assert fastest is not None
        assert fastest.gap <= PROVED
        assert 1 - 1e-9 <= used_fraction([leg], [fastest.timing]) <= 1
        assert double_s(leg) < fastest.timing.duration <= smoothstep.duration * (1 + 1e-9)
        assert [fastest.timing.easing.end(k) for k in range(continuity + 1)] == pytest.approx(
            [1.0] + [0.0] * continuity, abs=1e-9
        )


def test_a_higher_degree_is_never_slower():
    legs = random_demands(4, 20)
    times = np.array(
        [[f.timing.duration for f in solve_legs(legs, PolynomialBasis(d, 2))] for d in (5, 7, 9, 13)]
    )
    assert np.all(times[1:] <= times[:-1] * (1 + PROVED))
    assert np.all(np.min(times[1:] / times[:-1], axis=1) < 1 - 1e-4)


def test_a_law_is_its_own_mirror_image():
    (found,) = solve_legs(random_demands(6, 1), PolynomialBasis(9, 2))
    tau = np.linspace(0, 1, 101)
    np.testing.assert_allclose(found.timing.easing(tau) + found.timing.easing(1 - tau), 1.0, atol=1e-13)


def test_what_stands_beside_a_leg_does_not_matter():
    legs, basis = random_demands(8, 8), PolynomialBasis(11, 2)
    alone = [solve_legs([leg], basis)[0].timing.duration for leg in legs]
    assert [f.timing.duration for f in solve_legs(legs, basis)] == pytest.approx(alone, rel=1e-8)


def test_limits_in_another_time_give_the_least_time_in_that():
    scale, limits = 1e3, {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}
    quick = {name: bound * scale ** ORDERS[name] for name, bound in limits.items()}
    one, other = solve_legs([demand(1.3, limits), demand(1.3, quick)], PolynomialBasis(9, 2))
    assert other.timing.duration * scale == pytest.approx(one.timing.duration, rel=1e-9)


def test_limits_by_axis_and_on_momentum_are_bounds_on_the_rate_about_the_leg_s_axis():
    inertia = np.diag([4.0, 9.0, 2.0])
    limits = {"velocity": (0.5, 0.4, 0.9), "jerk": (8.0, 3.0, 4.0), "momentum": 1.1}
    by_axis = demand(1.0, limits, inertia=inertia)
    w = min(
        least_quotient(limits["velocity"], AXIS), limits["momentum"] / float(np.linalg.norm(inertia @ AXIS))
    )
    plain = demand(1.0, {"velocity": float(w), "jerk": float(least_quotient(limits["jerk"], AXIS))})
    one, other = solve_legs([by_axis, plain], PolynomialBasis(9, 2))
    assert one.timing.duration == pytest.approx(other.timing.duration, rel=1e-9)
    assert used_fraction([by_axis], [one.timing]) <= 1
    assert not are_rates_limited(demand(1.0, {"torque": 1.0}, inertia=np.diag([4.0, 9.0, 2.0])))


def plain_runs(count, family=PolynomialFamily(9, 2), seed=2):  # noqa: B008
    return [RunProblem((leg,), family) for leg in random_demands(seed, count)]


def test_plain_legs_need_no_solver():
    code = (
        "from tests.test_single_legs import plain_runs, solve_runs\n"
        "import timelaw.cli.design, timelaw.pipeline\n"
        "assert len(solve_runs(plain_runs(3)).timings) == 3"
    )
    assert "casadi" not in loaded(code)


def test_what_the_exchange_does_not_reach_is_left_to_the_nonlinear_program(monkeypatch):
    runs, real = plain_runs(3), least_times.find_least_times
    expected = [s.duration for s in solve_distinct(runs)]

    def lose_one(*given):
        found = real(*given)
        found.bound[1] = np.nan
        return found

    monkeypatch.setattr(least_times, "find_least_times", lose_one)
    found = list(solve_distinct(runs))
    assert [s.duration for s in found] == pytest.approx(expected, rel=SLOWER)
    assert found[1].rows > found[0].rows == 3  # points of a program; the rows of a reference


def test_other_runs_stand_between_plain_ones(monkeypatch):
    """In their order, each told as its turn comes, in as many parts as there are."""
    monkeypatch.setattr(single_runs, "TOGETHER", 2)
    runs = plain_runs(4)
    fixed = demand(1.0, {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}, duration=9.0)
    runs.insert(2, RunProblem((fixed,), runs[0].family))
    told = []
    found = list(solve_distinct(runs, lambda *what: told.append(what)))
    assert told == [("solving distinct runs", k, 5) for k in range(5)]
    assert found[2].duration == pytest.approx(9.0)
    alone = [solve_distinct([run]) for run in runs]
    assert [s.duration for s in found] == pytest.approx([next(s).duration for s in alone], rel=1e-8)


def test_legs_that_are_late_are_smoothsteps():
    runs = plain_runs(3)
    with limit_time(1e-9):
        found = solve_runs(runs)
    assert found.stopped_early
    slow = time_legs([run.demands[0] for run in runs], 2)
    assert [t.duration for t in found.timings] == [t.duration for t in slow]


@pytest.mark.campaign
def test_the_exchange_against_the_nonlinear_program_on_a_thousand_legs():
    """Six decades of each limit; measured on 150 of them: never slower, faster by 6e-7 at most."""
    runs = plain_runs(1000, seed=12)
    found = solve_legs([run.demands[0] for run in runs], PolynomialBasis(9, 2))
    assert None not in found
    for run, fastest in zip(runs, found, strict=True):
        other = solve_run(run)
        assert other.status in (Status.OPTIMAL, Status.SECOND_START)
        assert fastest.gap <= PROVED
        assert fastest.timing.duration <= other.duration * (1 + SLOWER)
        assert fastest.timing.duration >= other.duration * (1 - SLOWER)
        assert fastest.timing.duration >= double_s(run.demands[0])


@pytest.mark.campaign
@pytest.mark.parametrize("degree", range(5, 32))
def test_no_leg_is_left_over(degree):
    for continuity in range(2, min((degree - 1) // 2, 4) + 1):
        legs = random_demands(degree, 300)
        found = solve_legs(legs, PolynomialBasis(degree, continuity))
        assert None not in found
        assert max(f.gap for f in found) <= 1e-6
