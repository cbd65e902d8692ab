"""The nonlinear program against linear programs, closed forms, and itself under a failing solver."""

from itertools import pairwise

import numpy as np
import pytest

from tests.cases import demand, demands, random_limits
from tests.oracles import QUINTIC_PEAKS, LinearProgram, smoothstep_duration
from timelaw.easing.family import PolynomialFamily, SplineFamily
from timelaw.easing.registry import BASES
from timelaw.easing.time_scaling import used_fraction
from timelaw.least_time.double_s import double_s_time
from timelaw.nlp import RunProblem, Status
from timelaw.nlp import exchange as exchange_module
from timelaw.nlp.ipopt import Outcome
from timelaw.nlp.single_runs import solve_run
from timelaw.nlp.solution import GAP
from timelaw.nlp.verdicts import Verdict
from timelaw.problem.problem import EasingModel

DEG = np.pi / 180
ROBOT = {"velocity": 60 * DEG, "acceleration": 120 * DEG, "jerk": 600 * DEG}
ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3}
LP_AGREEMENT = 1e-4  # relative; what the project promises. Measured: some 1e-7.


def solve(angles, limits, degree=9, continuity=2):
    return solve_run(RunProblem(demands(angles, limits), PolynomialFamily(degree, continuity)))


def linear_program(angles, limits, degree=9, continuity=2, shares=(1.0,)):
    orders = {ORDERS[name]: bound for name, bound in limits.items()}
    return LinearProgram(degree, continuity, tuple(angles), orders, tuple(shares)).solve()


def check_against_closed_forms(angles, limits, solution, continuity=2):
    bounds = tuple(limits.values())
    total = sum(angles)
    assert solution.duration >= double_s_time(total, *bounds)
    if continuity == 2:
        assert solution.duration <= smoothstep_duration(QUINTIC_PEAKS, total, bounds) * (1 + 1e-9)
    assert used_fraction(demands(angles, limits), solution.timings) <= 1


def random_leg(seed):
    rng = np.random.default_rng(seed)
    degree, continuity = int(rng.choice([7, 9, 11, 13, 17, 21])), int(rng.choice([2, 2, 3]))
    return (float(10 ** rng.uniform(-1.5, 0.49)),), random_limits(rng), degree, continuity


def check_leg(seed):
    angles, limits, degree, continuity = random_leg(seed)
    solution = solve(angles, limits, degree, continuity)
    lower, upper = linear_program(angles, limits, degree, continuity)
    assert solution.status in (Status.OPTIMAL, Status.SECOND_START)
    assert lower * (1 - LP_AGREEMENT) <= solution.duration <= upper * (1 + LP_AGREEMENT)
    check_against_closed_forms(angles, limits, solution, continuity)


@pytest.mark.parametrize("seed", range(2))
def test_random_legs_equal_the_linear_program(seed):
    check_leg(seed)


@pytest.mark.campaign
@pytest.mark.parametrize("seed", range(1000, 1300))
def test_many_random_legs_equal_the_linear_program(seed):
    check_leg(seed)


def check_run(seed):
    rng = np.random.default_rng(seed)
    limits, degree = random_limits(rng), int(rng.choice([5, 7, 9, 13, 17]))
    angles = tuple(float(a) for a in 10 ** rng.uniform(-1, 0.49, rng.integers(2, 5)))
    solution = solve(angles, limits, degree)
    assert solution.status in (Status.OPTIMAL, Status.SECOND_START)
    check_against_closed_forms(angles, limits, solution)


@pytest.mark.parametrize("seed", range(8))
def test_random_runs_converge_between_quintic_and_double_s(seed):
    check_run(seed)


@pytest.mark.campaign
@pytest.mark.parametrize("seed", range(2000, 2300))
def test_many_random_runs_converge(seed):
    check_run(seed)


@pytest.mark.parametrize("continuity", [2, 3])
@pytest.mark.parametrize("given", [["velocity"], ["acceleration"], ["jerk"], ["velocity", "jerk"]])
def test_any_limits_may_be_left_out(given, continuity):
    limits = {name: ROBOT[name] for name in given}
    lower, upper = linear_program((1.0,), limits, 9, continuity)
    solution = solve((1.0,), limits, 9, continuity)
    assert lower * (1 - LP_AGREEMENT) <= solution.duration <= upper * (1 + LP_AGREEMENT)


@pytest.mark.parametrize(
    ("first", "second", "degree"),
    [
        (30, 100, 7),
        *(pytest.param(120, second, 9, marks=pytest.mark.campaign) for second in (60, 120)),
    ],
)
def test_pairs_of_legs_equal_the_linear_program_over_all_shares_of_time(first, second, degree):
    """For given shares of the total time the pair is a linear program; the best share is searched."""
    angles = (first * DEG, second * DEG)
    solution = solve(angles, ROBOT, degree)
    share = solution.timings[0].duration / solution.duration
    best = {
        step: linear_program(angles, ROBOT, degree, shares=(share + step, 1 - share - step))[0]
        for step in (-0.1, -0.01, 0.0, 0.01, 0.1)
    }
    assert min(best, key=best.get) == 0.0
    assert solution.duration == pytest.approx(best[0.0], rel=LP_AGREEMENT)


def test_the_promised_numbers():
    assert solve((120 * DEG,), ROBOT).duration == pytest.approx(2.859, abs=1e-3)
    assert solve((120 * DEG,) * 2, ROBOT).duration == pytest.approx(4.845, abs=1e-3)


def test_a_higher_degree_is_never_slower_and_double_s_never_reached():
    durations = [solve((120 * DEG,), ROBOT, degree).duration for degree in (5, 7, 9, 11, 13, 21, 31)]
    assert all(b <= a * (1 + 2e-6) for a, b in pairwise(durations))
    assert durations[0] == pytest.approx(3.75, rel=1e-9)
    assert durations[-1] > 2.7


@pytest.mark.parametrize("seed", range(6))
def test_time_scaling(seed):
    """Limits (c w, c² a, c³ j) give T/c and the same easing."""
    rng = np.random.default_rng(seed)
    limits, c = random_limits(rng), float(10 ** rng.uniform(-2, 2))
    scaled = {name: bound * c ** ORDERS[name] for name, bound in limits.items()}
    one, other = solve((1.3,), limits), solve((1.3,), scaled)
    assert other.duration == pytest.approx(one.duration / c, rel=3e-6)


@pytest.mark.parametrize("limit", list(ROBOT))
def test_each_limit_bites(limit):
    """Held with its row, broken without it."""
    tight = {name: bound * (0.3 if name == limit else 3) for name, bound in ROBOT.items()}
    angles = (120 * DEG,)
    with_row, without = solve(angles, tight), solve(angles, {n: b for n, b in tight.items() if n != limit})
    only = demands(angles, {limit: tight[limit]})
    assert used_fraction(only, with_row.timings) == pytest.approx(1, rel=1e-5)
    assert used_fraction(only, without.timings) > 1.05


def test_equal_legs_of_a_run_mirror_each_other():
    solution = solve((72 * DEG,) * 4, ROBOT)
    durations = [t.duration for t in solution.timings]
    np.testing.assert_allclose(durations, durations[::-1], rtol=1e-4)
    assert solution.duration < 0.75 * 4 * solve((72 * DEG,), ROBOT).duration


def failing(times):
    """A solver that fails for the first `times` calls, and says so."""
    real, calls = exchange_module.solve, []

    def solve_or_fail(symbols, start, bounds, *, strict):
        calls.append(None)
        if len(calls) <= times:
            return Outcome(np.full(len(start), np.nan), Verdict.RESTORATION, 300)
        return real(symbols, start, bounds, strict=strict)

    return solve_or_fail


def test_a_failing_solver_gets_a_second_start(monkeypatch):
    expected = solve((120 * DEG,), ROBOT).duration
    monkeypatch.setattr(exchange_module, "solve", failing(1))
    solution = solve((120 * DEG,), ROBOT)
    assert solution.status is Status.SECOND_START
    assert solution.duration == pytest.approx(expected, rel=1e-5)


def test_a_solver_that_always_fails_leaves_the_best_closed_form(monkeypatch):
    monkeypatch.setattr(exchange_module, "solve", failing(10**9))
    solution = solve((120 * DEG,) * 2, ROBOT)
    assert solution.status is Status.CLOSED_FORM
    assert "another" in solution.status.value
    assert solution.duration == pytest.approx(
        smoothstep_duration(QUINTIC_PEAKS, 240 * DEG, tuple(ROBOT.values()))
    )
    assert used_fraction(demands((120 * DEG,) * 2, ROBOT), solution.timings) <= 1


def test_a_solver_that_claims_success_with_a_slow_law_is_not_believed(monkeypatch):
    def slow(_symbols, start, _bounds, *, strict):  # noqa: ARG001
        return Outcome(start * np.where(np.arange(len(start)) < 1, 50.0, 1.0), Verdict.SOLVED, 1)

    monkeypatch.setattr(exchange_module, "solve", slow)
    monkeypatch.setattr(exchange_module, "ROUNDS", 1)
    solution = solve((120 * DEG,), ROBOT)
    assert solution.duration <= smoothstep_duration(QUINTIC_PEAKS, 120 * DEG, tuple(ROBOT.values())) * (
        1 + 1e-9
    )


@pytest.mark.parametrize("tiny", [1e-2, 1e-3, 1e-4, 1e-5])
def test_a_tiny_leg_inside_a_run_costs_next_to_nothing(tiny):
    """Two legs of 1 rad take 2.6647 s; a node shortly after their middle need not slow them down."""
    without, with_node = solve((1.0, 1.0), ROBOT), solve((1.0, tiny, 1.0), ROBOT)
    assert with_node.duration <= without.duration + 1.01 * tiny / ROBOT["velocity"] + 0.01


@pytest.mark.parametrize(("degree", "continuity"), [(6, 2), (8, 3)])
@pytest.mark.parametrize("given", [["velocity"], ["velocity", "acceleration", "jerk"]])
def test_where_the_smoothstep_is_the_optimum_the_solver_has_not_failed(given, degree, continuity):
    solution = solve((0.66,), {name: ROBOT[name] for name in given}, degree, continuity)
    assert solution.status is Status.OPTIMAL


@pytest.mark.parametrize("seed", range(8))
def test_the_highest_degree_is_held_to_the_last_digit(seed):
    angles, limits, _, _ = random_leg(seed)
    solution = solve(angles, limits, 31, 3)
    assert used_fraction(demands(angles, limits), solution.timings) <= 1


def test_a_solver_that_fails_on_high_degrees_starts_from_a_simpler_easing(monkeypatch):
    expected = solve((120 * DEG,), ROBOT, 13).duration
    real = exchange_module.solve

    def only_small(symbols, start, bounds, *, strict):
        if len(start) > 10:
            return Outcome(start, Verdict.ITERATIONS, 300)
        return real(symbols, start, bounds, strict=strict)

    monkeypatch.setattr(exchange_module, "solve", only_small)
    solution = solve((120 * DEG,), ROBOT, 21)
    assert solution.status is Status.SIMPLER
    assert solution.duration == pytest.approx(expected, rel=1e-5)


def test_no_solution_whose_gap_is_above_its_tolerance_is_called_optimal(monkeypatch):
    """One round leaves excess between its points; the stretch restores the limits, and the status says what is left."""
    monkeypatch.setattr(exchange_module, "ROUNDS", 1)
    solution = solve((120 * DEG,), ROBOT, 13)
    assert solution.gap > GAP
    assert solution.status is Status.GAP_LEFT
    assert used_fraction(demands((120 * DEG,), ROBOT), solution.timings) <= 1
    monkeypatch.undo()
    optimum = solve((120 * DEG,), ROBOT, 13)
    assert optimum.status is Status.OPTIMAL
    assert optimum.gap <= GAP
    assert optimum.duration <= solution.duration <= optimum.duration * (1 + 2 * solution.gap)


def test_a_run_that_is_entered_moving_is_measured_by_its_own_limit():
    """Half a rad entered at speed: from rest it would take longer, and no law may seem to beat its limit."""
    problem = RunProblem(demands((0.5,), ROBOT), PolynomialFamily(9, 2), start=(0.9,))
    solution = solve_run(problem)
    assert solution.duration >= problem.run.limit
    assert problem.run.limit < RunProblem(demands((0.5,), ROBOT), PolynomialFamily(9, 2)).run.limit


def test_an_optimum_that_equals_the_closed_form_is_not_called_a_failure():
    """A cubic spline under torque from outside is the double-S it starts from, to the last digits."""
    inertia = np.diag([12.0, 10.0, 8.0])
    leg = demand(1.0, {"torque": (0.1, 0.1, 0.1), "jerk": 0.0035}, (0.0, 1.0, 0.0), inertia)
    solution = solve_run(RunProblem((leg,), SplineFamily(3, 28, 2)))
    assert solution.status is Status.OPTIMAL
    assert solution.rounds >= 1


@pytest.mark.parametrize(
    ("continuity", "degree"), [(r, p) for r in (1, 2, 3, 4) for p in range(max(3, r + 1), 8)]
)
def test_the_fewest_intervals_that_a_spline_may_have_give_a_law(continuity, degree):
    """With nothing left to choose but the durations; on two legs too, where the node's rates are chosen."""
    fewest = BASES["spline"].least_intervals(EasingModel(basis="spline", degree=degree), continuity)
    family = SplineFamily(degree, fewest, continuity)
    limits = ROBOT if continuity > 1 else {k: v for k, v in ROBOT.items() if k != "jerk"}
    for angles in ((1.0,), (0.5, 0.7)):
        solution = solve_run(RunProblem(demands(angles, limits), family))
        assert used_fraction(demands(angles, limits), solution.timings) <= 1
