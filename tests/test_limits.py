"""Limits on a leg: Euler's equation by finite differences, rotated problems, both sides of each limit."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import AXIS, demand
from timelaw.easing import Profile, Timing
from timelaw.easing.family import PolynomialFamily
from timelaw.easing.smoothstep import control_points
from timelaw.easing.time_scaling import fit_to_limits, list_used, used_fraction
from timelaw.least_time.phase_plane import phase_plane_time
from timelaw.limits import LIMITS, Demand, list_rows, make_limits
from timelaw.limits.body import RigidBody
from timelaw.nlp import RunProblem, Status
from timelaw.nlp.single_runs import solve_run
from timelaw.numerics.bernstein import evaluate
from timelaw.numerics.polynomial import Polynomial

INERTIA = np.array([[12.0, 1.0, -0.5], [1.0, 10.0, 0.7], [-0.5, 0.7, 8.0]])
ROBOT = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}
BITING = {
    "velocity": {"velocity": 0.4},
    "velocity by axis": {"velocity": (0.3, 9.0, 9.0)},
    "acceleration": {"acceleration": 0.5},
    "acceleration by axis": {"acceleration": (9.0, 0.3, 9.0)},
    "jerk": {"jerk": 2.0},
    "jerk by axis": {"jerk": (99.0, 99.0, 1.0)},
    "snap": {"snap": 15.0},
    "torque": {"torque": 6.0},
    "torque by axis": {"torque": (90.0, 3.0, 90.0)},
    "momentum": {"momentum": 4.0},
    "momentum by axis": {"momentum": (90.0, 90.0, 2.0)},
}


def solve(limits, angle=2.0, axis=AXIS, degree=9, continuity=3):
    leg = demand(angle, limits, axis, INERTIA)
    return leg, solve_run(RunProblem((leg,), PolynomialFamily(degree, continuity)))


def test_every_limit_of_the_registry_is_tried():
    """Those on the body's origin by the tests of translations: on an arc it rests."""
    turning = {name for name, kind in LIMITS.items() if not kind.needs_translation}
    assert {name.split()[0] for name in BITING} == turning


@pytest.mark.parametrize("name", BITING)
def test_each_limit_bites(name):
    """Held with its row, broken without it."""
    limits = {**ROBOT, **BITING[name]}
    leg, with_row = solve(limits)
    assert with_row.status is Status.OPTIMAL
    assert used_fraction([leg], with_row.timings) <= 1
    only = demand(2.0, BITING[name], inertia=INERTIA)
    assert used_fraction([only], with_row.timings) == pytest.approx(1, rel=1e-4)
    _, without = solve({n: b for n, b in ROBOT.items() if n not in BITING[name]} or {"jerk": 50.0})
    assert used_fraction([only], without.timings) > 1.02


def motion(timing, angle, axis):
    """ω(t) and α(t) of a leg, sampled."""
    tau = np.linspace(0, 1, 2001)
    rates = [angle / timing.duration**k * timing.easing(tau, k) for k in (1, 2)]
    return [np.outer(rate, axis) for rate in rates]


@pytest.mark.parametrize("seed", range(10))
def test_torque_and_momentum_are_eulers(seed):
    """τ = dL/dt + ω × L, L = J ω, evaluated as vectors; the rows see the same largest values."""
    rng = np.random.default_rng(seed)
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    timing = Timing(1.7, Profile.single(control_points(3)))
    omega, alpha = motion(timing, 2.0, axis)
    momentum = omega @ INERTIA.T
    torque = alpha @ INERTIA.T + np.cross(omega, momentum)
    expected = {
        "torque": np.max(np.linalg.norm(torque, axis=1)),
        "momentum": np.max(np.linalg.norm(momentum, axis=1)),
        **{f"torque {n}": v for n, v in zip("xyz", np.max(np.abs(torque), axis=0), strict=True)},
        **{f"momentum {n}": v for n, v in zip("xyz", np.max(np.abs(momentum), axis=0), strict=True)},
    }
    for bounds in ({"torque": 1.0, "momentum": 1.0}, {"torque": (1.0,) * 3, "momentum": (1.0,) * 3}):
        rows = list_rows(make_limits(bounds, RigidBody(INERTIA)), axis)
        leg = Demand(2.0, rows)  # with those that another one implies
        found = {row.label: ratio ** (1 / row.root) for row, ratio in list_used([leg], [timing])}
        assert found == pytest.approx({label: expected[label] for label in found}, rel=1e-5)
        assert len(found) == len(rows)


BOUNDS = {"norm": 1.5, "by axis": (1.0, 2.0, 3.0)}


@pytest.mark.parametrize("actuator", ["external", "wheels"])
@pytest.mark.parametrize("form", BOUNDS)
@pytest.mark.parametrize("name", [name for name, kind in LIMITS.items() if not kind.needs_translation])
def test_on_a_leg_the_formula_in_vectors_is_what_the_rows_say(name, form, actuator):
    """Every limit of the registry, with ω = n φ', α = n φ'', … as arrays over time and as polynomials."""
    rng = np.random.default_rng(7)
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    (limit,) = make_limits({name: BOUNDS[form]}, RigidBody(INERTIA, actuator))
    rates = {k: rng.normal(size=50) for k in (1, 2, 3, 4)}
    rows = {row.label: row for row in limit.on(axis)}
    formulas = limit.of({k: [n * rate for n in axis] for k, rate in rates.items()})
    assert [formula.label for formula in formulas] == list(rows)
    polynomials = {k: Polynomial(rng.normal(size=6 - k)) for k in rates}
    vectors = limit.of({k: [float(n) * p for n in axis] for k, p in polynomials.items()})
    for formula, vector in zip(formulas, vectors, strict=True):
        row = rows[formula.label]
        size = np.array([row.size(abs(g)) for g in row.value(rates)])
        np.testing.assert_allclose(np.abs(formula.value) ** (1 / formula.root), size, rtol=1e-11, atol=1e-13)
        assert formula.bound ** (1 / formula.root) == pytest.approx(row.size(row.bound), rel=1e-14)
        power = formula.root // row.root  # the formula of a norm is a square, a row need not be
        along = row.value(polynomials)
        for u in (0.0, 0.3, 1.0):
            expected = abs(float(evaluate(along.control, u))) ** power
            assert abs(float(evaluate(vector.value.control, u))) == pytest.approx(
                expected, rel=1e-9, abs=1e-12
            )


def test_the_formula_of_the_momentum_counts_that_of_body_and_wheels():
    (limit,) = make_limits({"momentum": 1.0}, RigidBody(INERTIA, "wheels", np.array([1.0, 2.0, 3.0])))
    (formula,) = limit.of({1: [0.1, 0.2, -0.1]}, [1.0, 2.0, 3.0])
    stored = np.array([1.0, 2.0, 3.0]) - INERTIA @ [0.1, 0.2, -0.1]
    assert formula.value == pytest.approx(stored @ stored)


@pytest.mark.parametrize("limit", ["velocity", "acceleration", "jerk", "torque", "momentum"])
def test_rotating_axis_and_norm_leaves_norm_limits_alone_and_inertia_turns_along(limit):
    turn = Rotation.from_rotvec([0.3, -1.0, 0.6]).as_matrix()
    bounds = {limit: 3.0}
    one = demand(2.0, bounds, AXIS, INERTIA)
    other = demand(2.0, bounds, turn @ AXIS, turn @ INERTIA @ turn.T)
    timing = Timing(3.0, Profile.single(control_points(2)))
    assert used_fraction([one], [timing]) == pytest.approx(used_fraction([other], [timing]), rel=1e-12)


def test_per_axis_limits_of_a_permuted_problem_give_the_same_law():
    """Rotating the whole problem gives the law that the rotated limits give."""
    cycle = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]], dtype=float)  # x→y→z→x
    limits = {"velocity": (0.5, 0.7, 0.9), "acceleration": (2.0, 1.0, 3.0), "jerk": (10.0, 12.0, 8.0)}
    turned = {name: tuple(np.array(b) @ cycle.T) for name, b in limits.items()}
    one, other = solve(limits)[1], solve(turned, axis=cycle @ AXIS)[1]
    assert other.duration == pytest.approx(one.duration, rel=1e-9)


def test_an_axis_without_a_component_is_not_limited_along_it():
    leg = demand(2.0, {"velocity": (1e-3, 1.0, 1.0)}, (0.0, 0.6, 0.8))
    assert fit_to_limits([leg], [Timing(1.0, Profile.single(control_points(2)))])[
        0
    ].duration == pytest.approx(2.0 * 15 / 8 * 0.8, rel=1e-10)


@pytest.mark.parametrize("seed", range(20))
def test_polynomial_arithmetic_carries_its_rounding(seed):
    from fractions import Fraction
    from math import comb

    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=rng.integers(1, 9)), rng.normal(size=rng.integers(1, 9))
    product, total = Polynomial(a) * Polynomial(b), Polynomial(a) + Polynomial(b)
    m, n = len(a) - 1, len(b) - 1
    for k, c in enumerate(product.control):
        exact = sum(
            Fraction(comb(m, i) * comb(n, k - i), comb(m + n, k))
            * Fraction(float(a[i]))
            * Fraction(float(b[k - i]))
            for i in range(max(0, k - n), min(m, k) + 1)
        )
        assert abs(Fraction(float(c)) - exact) <= Fraction(product.error)
    assert total.control[0] == a[0] + b[0]
    assert total.control[-1] == a[-1] + b[-1]


# The phase plane


def bang_bang(angle, rows, steps=20000):
    """Least time by marching: accelerate as hard as every row allows, brake likewise, over angle."""

    def allowed(v, sign):
        low, high = 0.0, 1e3
        for _ in range(60):
            a = (low + high) / 2
            ok = all(abs(r.value({1: v, 2: sign * a, 3: 0.0})) <= r.bound for r in rows)
            low, high = (a, high) if ok else (low, a)
        return low

    ds = angle / steps
    up, down = np.zeros(steps + 1), np.zeros(steps + 1)
    for i in range(steps):
        up[i + 1] = up[i] + 2 * ds * allowed(np.sqrt(up[i]), 1)
        down[i + 1] = down[i] + 2 * ds * allowed(np.sqrt(down[i]), -1)
    v = np.sqrt(np.minimum(up, down[::-1]))
    return float(np.sum(2 * ds / (v[1:] + v[:-1])))


@pytest.mark.parametrize("bounds", [{"torque": 6.0}, {"torque": (4.0, 3.0, 5.0)}])
def test_least_time_under_torque_equals_marching_along_the_angle(bounds):
    leg = demand(2.0, bounds, AXIS, INERTIA)
    assert phase_plane_time(2.0, [leg.rows]) == pytest.approx(bang_bang(2.0, leg.rows, 2000), rel=3e-3)


def test_least_time_without_gyroscopic_torque_is_the_acceleration_limit():
    """About a principal axis torque is a plain limit τ/J on φ''."""
    leg = demand(2.0, {"torque": 6.0}, (1.0, 0.0, 0.0), np.diag([12.0, 10.0, 8.0]))
    assert phase_plane_time(2.0, [leg.rows]) == pytest.approx(2 * np.sqrt(2.0 * 12 / 6.0), rel=1e-7)
