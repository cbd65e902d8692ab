"""Programs put together from kernels: values as the laws themselves have them, derivatives as differences say."""

import numpy as np
import pytest

from timelaw.easing import Timing
from timelaw.easing.family import PolynomialFamily, SplineFamily
from timelaw.limits import Demand, drop_implied, list_rows, make_limits
from timelaw.limits.coupled_row import DriftRow, TorqueNormRow, TorqueRow
from timelaw.nlp import ipopt
from timelaw.nlp.assembly import assemble
from timelaw.nlp.monomials import expand_monomials
from timelaw.nlp.program import Program, RunProblem
from timelaw.nlp.rooms import list_points, list_rooms, list_stays
from timelaw.nlp.single_runs import solve_run
from timelaw.nlp.transcription import transcribe
from timelaw.nlp.variables import Variables
from timelaw.objectives import OBJECTIVES
from timelaw.requirements.given_times import Budget

NORMS = drop_implied(
    list_rows(make_limits({"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}), np.array([0.0, 0.0, 1.0]))
)
TORQUES = (
    TorqueRow("torque", "torque x", "N·m", 3.0, 0.7, 2.0),
    TorqueRow("torque", "torque y", "N·m", -1.0, 1.2, 2.5),
    TorqueNormRow("torque", "torque", "N·m", 3.0, 1.4, 9.0),
    DriftRow("torque", "torque z", "N·m", 1.0, 0.3, 2.0),
)
NORM = TORQUES[2]
STEP = 1e-6
DIRECTIONS = 4
POLYNOMIAL, SPLINE = PolynomialFamily(9, 2), SplineFamily(4, 12, 2)


def leg(angle, *rows):
    return Demand(angle, rows or NORMS, torque=NORM)


MIXED = (
    RunProblem((leg(1.0), leg(0.4, *NORMS, *TORQUES), leg(0.7)), POLYNOMIAL),
    RunProblem((leg(1.3),), SPLINE),
    RunProblem((leg(0.9), leg(0.6, *TORQUES)), SPLINE),
    RunProblem((leg(0.8),), POLYNOMIAL, (0.3, 0.1), (0.2,)),
)
TIMES = (Budget(3, 5.0), Budget(7, 14.0))
PROGRAMS = {
    **{name: Program(MIXED, objective, budgets=TIMES) for name, objective in OBJECTIVES.items()},
    "weighed": Program(MIXED, OBJECTIVES["energy"], weight=0.7),
    "elastic": Program(MIXED[:2], counts=(2, 3)),
}


@pytest.fixture(params=PROGRAMS, scope="module")
def case(request):
    """A program, its variables somewhere, its transcription and what is asked of it."""
    program = PROGRAMS[request.param]
    start = [timing for run in program.runs for timing in run.family.start(run.demands)]
    variables = Variables(program, np.array([timing.duration for timing in start]))
    x = variables.pack(start, 1.3) + np.random.default_rng(1).uniform(0.0, 0.05, variables.size)
    points, stay = list_points(program), list_stays(program)
    transcription = transcribe(program, variables, points, list_rooms(program, points), stay, 1.7)
    return program, variables, x, transcription, points, stay


def rate(demand, timing, tau, order):
    return demand.angle / timing.duration**order * timing.easing(tau, order)


def test_rows_are_those_of_the_law(case):
    program, variables, x, transcription, points, stay = case
    timings = variables.timings(x)
    expected = []
    for demand, timing, rows, near in zip(program.demands, timings, points, stay, strict=True):
        for row, tau in zip(demand.rows, rows, strict=True):
            g = row.value({k: rate(demand, timing, tau, k) for k in row.orders}) / row.bound
            if program.objective.scales_limits:
                expected += [
                    *(g / 1.7**row.root - x[-1] ** row.root),
                    *(-g / 1.7**row.root - x[-1] ** row.root),
                ]
            else:
                expected += [*g]
        expected += [*timing.easing(near)]
    made = np.array([t.duration for t in timings]) * program.leg_counts
    expected += [np.sum(made[: budget.legs]) / budget.time for budget in program.budgets]
    value = np.array(assemble(transcription.layout)[0](x, transcription.numbers["p"])[1]).ravel()
    np.testing.assert_allclose(np.sort(value), np.sort(expected), rtol=1e-8, atol=1e-8)
    assert len(value) == len(transcription.numbers["lbg"]) == len(transcription.numbers["ubg"])


def test_the_objective_is_that_of_the_law(case):
    program, variables, x, transcription, *_ = case
    timings = variables.timings(x)
    legs, laws = program.repeat(program.demands), program.repeat(timings)
    time = sum(t.duration for t in laws) / np.average(variables.units, weights=program.leg_counts)
    name = program.objective.name
    effort = 0.0 if name in ("time", "peak") else program.objective.measure(legs, laws) / 1.7
    calm = OBJECTIVES["jerk"].measure(legs, laws) / 1.7
    expected = {
        "time": time if program.elastic else time + 1e-4 * len(legs) * calm,
        "peak": x[-1],
    }.get(name, effort if program.weight is None else time / len(legs) + program.weight * effort)
    value = float(assemble(transcription.layout)[0](x, transcription.numbers["p"])[0])
    assert value == pytest.approx(expected, rel=1e-9)


def test_derivatives_are_those_of_differences(case):
    *_, x, transcription, _, _ = case
    p = transcription.numbers["p"]
    program, derivatives = assemble(transcription.layout)
    factors = np.random.default_rng(2).normal(size=len(transcription.numbers["lbg"]))

    def slopes(x):
        gradient = np.array(derivatives["grad_f"](x, p)[1]).ravel()
        return gradient, np.array(derivatives["jac_g"](x, p)[1])

    def lagrangian_slope(x):
        gradient, jacobian = slopes(x)
        return 0.6 * gradient + factors @ jacobian

    gradient, jacobian = slopes(x)
    upper = np.array(derivatives["hess_lag"](x, p, 0.6, factors))
    hessian = upper + np.triu(upper, 1).T
    for seed in range(DIRECTIONS):
        direction = np.random.default_rng(seed).normal(size=len(x))
        ahead, behind = (program(x + side * STEP * direction, p) for side in (1, -1))
        pairs = zip((gradient, jacobian), ahead, behind, strict=True)
        for slope, *values in pairs:
            one, other = (np.array(value).ravel() for value in values)
            along = slope @ direction
            rounding = 1e-6 * np.max(np.abs(along)) + 1e-8 * np.max(np.abs(one))
            np.testing.assert_allclose(along, (one - other) / (2 * STEP), rtol=0, atol=rounding)
        ends = (lagrangian_slope(x + side * STEP * direction) for side in (1, -1))
        curve = np.subtract(*ends) / (2 * STEP)
        np.testing.assert_allclose(hessian @ direction, curve, atol=1e-5 * np.max(np.abs(curve)))


@pytest.mark.parametrize("row", TORQUES)
def test_monomials_are_the_row(row):
    exponents, coefficients = expand_monomials(row.value, row.orders)
    rates = {1: 0.7, 2: -1.9}
    value = sum(c * rates[1] ** a * rates[2] ** b for (a, b), c in zip(exponents, coefficients, strict=True))
    assert value == pytest.approx(row.value(rates), rel=1e-14)


def test_variables_and_back():
    program = PROGRAMS["jerk"]
    start = [timing for run in program.runs for timing in run.family.start(run.demands)]
    variables = Variables(program, np.array([timing.duration for timing in start]))
    x = variables.pack(start, 0.0)
    np.testing.assert_allclose(variables.pack(variables.timings(x), 0.0), x, atol=1e-9)
    slow = variables.timings(variables.stretched(x, np.full(len(start), 1.5)))
    for stretched, timing, demand in zip(slow[:-1], variables.timings(x), program.demands, strict=False):
        expected = Timing(timing.duration * 1.5, timing.easing)
        for order in range(3):
            np.testing.assert_allclose(
                rate(demand, stretched, np.linspace(0, 1, 9), order),
                rate(demand, expected, np.linspace(0, 1, 9), order),
                atol=1e-9,
            )


def test_alike_legs_share_their_solvers():
    ipopt.keep_solver.cache_clear()
    for angle in np.linspace(0.9, 1.1, 6):
        solve_run(RunProblem((leg(float(angle)),), POLYNOMIAL))
    known = ipopt.keep_solver.cache_info()
    assert known.hits >= 2 * known.misses
