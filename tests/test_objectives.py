"""Objectives in a given time: closed forms of least jerk, energy and snap; peak; the split of durations."""

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.cases import demand
from tests.oracles import LinearProgram
from timelaw.easing.family import PolynomialFamily, SplineFamily
from timelaw.easing.smoothstep import control_points
from timelaw.easing.time_scaling import used_fraction
from timelaw.errors import InfeasibleError
from timelaw.nlp import Program, RunProblem, Status
from timelaw.nlp.all_runs import Deadline, solve_together
from timelaw.nlp.single_runs import solve_runs
from timelaw.nlp.solution import sum_durations
from timelaw.numerics.bernstein import elevate
from timelaw.objectives import EFFORTS
from timelaw.problem.objective import Goal, TotalTime
from timelaw.requirements.given_times import Budget

ROBOT = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}
INERTIA = np.diag([12.0, 10.0, 8.0])


def solve(angles, minimise, factor=None, degree=9, continuity=2, limits=ROBOT, weight=None):
    """Legs from stop to stop, in `factor` times their least time."""
    runs = [
        RunProblem((demand(a, limits, inertia=INERTIA),), PolynomialFamily(degree, continuity))
        for a in angles
    ]
    least = solve_runs(runs)
    given, goal = [], {"weight": weight}
    if factor is not None:
        time = factor * sum_durations(least.timings)
        given = [Deadline(Budget(len(angles), time), "objective.total_time", "the end", 0.0)]
        goal = {"total_time": TotalTime(time)}
    solution = solve_together(runs, least.timings, Goal(minimise=minimise, **goal), given)
    assert solution.status in (Status.OPTIMAL, Status.SECOND_START, Status.AT_MINIMUM)
    return Program(tuple(runs)), least.timings, solution


# what is least, continuity, limits, the easing it is known to have, and its cost in closed form
CLOSED = {
    "jerk": (2, ROBOT, 2, lambda a, t: 720 * a**2 / t**5),
    "energy": (1, {"velocity": 1.0, "acceleration": 2.0}, 1, lambda a, t: 12 * a**2 / t**3),
    "snap": (3, ROBOT, 3, lambda a, t: 100800 * a**2 / t**7),
}


@pytest.mark.parametrize("minimise", CLOSED)
def test_least_effort_in_a_given_time_is_the_smoothstep(minimise):
    continuity, limits, order, cost = CLOSED[minimise]
    program, _, solution = solve([2.0], minimise, 3.0, 9, continuity, limits)
    np.testing.assert_allclose(
        solution.timings[0].easing.derivative(0)[0].control,
        elevate(control_points(order), 9),
        rtol=0,
        atol=1e-8,
    )
    assert EFFORTS[minimise].measure(program.demands, solution.timings) == pytest.approx(
        cost(2.0, solution.duration), rel=1e-9
    )


@pytest.mark.parametrize(("minimise", "power"), [("jerk", 1 / 3), ("energy", 1 / 2)])
def test_durations_split_by_a_power_of_the_angle(minimise, power):
    continuity, limits, _, _ = CLOSED[minimise]
    angles = [2.0, 0.5, 1.0, 0.1]
    _, _, solution = solve(angles, minimise, 5.0, 9, continuity, limits)
    shares = [t.duration / a**power for t, a in zip(solution.timings, angles, strict=True)]
    np.testing.assert_allclose(shares, shares[0], rtol=1e-6)


@pytest.mark.parametrize("minimise", ["jerk", "energy", "snap", "torque"])
def test_limits_hold_and_effort_falls_with_time(minimise):
    efforts = []
    for factor in (1.02, 1.1, 1.5):
        program, least, solution = solve([2.0, 1.0], minimise, factor, 9, 3)
        assert used_fraction(program.demands, solution.timings) <= 1
        assert solution.duration == pytest.approx(factor * sum_durations(least), rel=1e-12)
        efforts.append(EFFORTS[minimise].measure(program.demands, solution.timings))
        stretched = [t.stretched(factor) for t in least]
        assert efforts[-1] <= EFFORTS[minimise].measure(program.demands, stretched)
    assert efforts[0] > efforts[1] > efforts[2]


def test_the_effort_of_torque_is_the_integral_of_eulers_equation():
    program, _, solution = solve([2.0], "torque", 1.5)
    timing, leg = solution.timings[0], program.demands[0]
    tau = (np.arange(4000) + 0.5) / 4000
    axis = np.array([2.0, 3.0, 6.0]) / 7
    first, second = (2.0 / timing.duration**k * timing.easing(tau, k) for k in (1, 2))
    torque = np.outer(second, INERTIA @ axis) + np.outer(first**2, np.cross(axis, INERTIA @ axis))
    expected = np.mean(np.sum(torque**2, axis=1)) * timing.duration
    assert leg.torque is not None
    assert EFFORTS["torque"].measure(program.demands, solution.timings) == pytest.approx(expected, rel=1e-5)


def test_peak_at_the_least_time_is_one():
    program, least, solution = solve([2.0, 0.7], "peak", 1.0)
    assert used_fraction(program.demands, solution.timings) == pytest.approx(1.0, abs=1e-9)
    assert solution.duration == pytest.approx(sum_durations(least), rel=1e-12)


def test_peak_scales_as_the_limits_would():
    """The least part p in time T is where T is the least time under p times the limits."""
    program, least, solution = solve([2.0], "peak", 2.0)

    def slower(p):
        limits = {k: p * bound for k, bound in enumerate(ROBOT.values(), 1)}
        return LinearProgram(9, 2, (2.0,), limits).solve()[0] - 2.0 * sum_durations(least)

    expected = brentq(slower, 0.2, 0.9, xtol=1e-5)
    assert used_fraction(program.demands, solution.timings) == pytest.approx(expected, rel=1e-4)


def test_too_little_time_says_the_earliest_and_how_much_is_missing():
    with pytest.raises(InfeasibleError, match=r"too early for the end: the earliest possible is .* later"):
        solve([2.0], "jerk", 0.9)


def test_weights_trade_time_against_effort():
    results = []
    for weight in (1e-3, 0.1, 10.0):
        program, least, solution = solve([2.0, 1.0], "jerk", weight=weight)
        assert used_fraction(program.demands, solution.timings) <= 1
        results.append(
            (
                solution.duration / sum_durations(least),
                EFFORTS["jerk"].measure(program.demands, solution.timings),
            )
        )
    times, efforts = zip(*results, strict=True)
    assert 1 <= times[0] < times[1] < times[2]
    assert efforts[0] > efforts[1] > efforts[2]
    # where no limit binds, E is the quintics' and falls as T^-5, so T + c E is least where T = 5 c E
    least_effort = EFFORTS["jerk"].measure(program.demands, least)
    quintic = sum(
        720 * d.angle**2 / t.duration**5 for d, t in zip(program.demands, solution.timings, strict=True)
    )
    assert efforts[2] == pytest.approx(quintic, rel=1e-6)
    assert 5 * 10.0 * efforts[2] / least_effort == pytest.approx(times[2], rel=1e-5)


FAMILIES = [SplineFamily(4, 33, 2), SplineFamily(5, 33, 2), SplineFamily(7, 33, 2), PolynomialFamily(31, 2)]
SLOW = {"acceleration": 10.0, "jerk": 15.0}


@pytest.mark.parametrize("family", FAMILIES, ids=str)
@pytest.mark.parametrize("legs", [3, pytest.param(6, marks=pytest.mark.campaign)])
def test_least_jerk_over_a_run_is_the_quintic_over_all_of_it(legs, family):
    """Nodes on the way cost nothing where legs may last as they like: ∫|jerk|² = 720 θ²/T⁵, free of limits.

    Of splines of many intervals the solver found none of these while rates at nodes bent their first intervals only.
    """
    run = RunProblem(tuple(demand(0.35, SLOW) for _ in range(legs)), family)
    least = solve_runs([run])
    effort, angle = EFFORTS["jerk"], 0.35 * legs
    time = 2.3 * sum_durations(least.timings)
    near = 1e-6 if isinstance(family, PolynomialFamily) or family.degree > 4 else 1e-4  # a quartic is none
    for goal, given in (
        ({"weight": 39.0}, []),
        (
            {"total_time": TotalTime(time)},
            [Deadline(Budget(legs, time), "objective.total_time", "the end", 0.0)],
        ),
    ):
        solution = solve_together([run], least.timings, Goal(minimise="jerk", **goal), given)
        assert solution.status is Status.OPTIMAL
        lasts = sum_durations(solution.timings)
        assert effort.measure(run.demands, solution.timings) == pytest.approx(
            720 * angle**2 / lasts**5, rel=near
        )
        if not given:  # T/T* + w E/E* has no slope there: 1/T* = 5 w E/(E* T)
            cost = effort.measure(run.demands, least.timings)
            best = (5 * 39 * 720 * angle**2 * sum_durations(least.timings) / cost) ** (1 / 6)
            assert lasts == pytest.approx(best, rel=1e-3)
