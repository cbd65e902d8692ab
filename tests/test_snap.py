"""The physical limit where the snap is limited: closed forms, linear programs, and laws that come near it."""

from math import inf

import numpy as np
import pytest
from scipy.optimize import linprog

from tests.cases import demand, demands
from timelaw.easing.family import PolynomialFamily, SplineFamily
from timelaw.least_time.double_s import double_s_time
from timelaw.least_time.physical_limit import run_limit
from timelaw.least_time.snap import symmetric_time
from timelaw.nlp import RunProblem
from timelaw.nlp.single_runs import solve_run

DEG = np.pi / 180
NAMES = ("velocity", "acceleration", "jerk", "snap")


def limit(angle, bounds):
    given = {name: bound for name, bound in zip(NAMES, bounds, strict=True) if bound < inf}
    return run_limit([demand(angle, given)])


def random_bounds(rng):
    return tuple(float(10 ** rng.uniform(-3, 3)) for _ in NAMES)


def sampled_least_time(angle, bounds, count=240):
    """The least time of a motion with piecewise constant snap, by bisection over linear programs.

    The limits hold at the samples of a grid, so it is somewhat below what holds for all t.
    """

    def reached(duration):
        h = duration / count
        powers = [
            np.zeros((count + 1, count)) for _ in range(4)
        ]  # rows: x, v, a, j at the grid, of unit snaps
        for k in range(count):
            for i in range(k + 1, count + 1):
                since = (i - k - 1) * h
                powers[3][i, k] = h
                powers[2][i, k] = h * since + h * h / 2
                powers[1][i, k] = h * since**2 / 2 + h * h * since / 2 + h**3 / 6
                powers[0][i, k] = h * since**3 / 6 + h * h * since**2 / 4 + h**3 * since / 6 + h**4 / 24
        caps = [
            (powers[order], bound) for order, bound in zip((1, 2, 3), bounds, strict=False) if bound < inf
        ]
        upper = np.vstack([m for m, _ in caps] + [-m for m, _ in caps]) if caps else None
        right = np.concatenate([np.full(count + 1, b) for _, b in caps] * 2) if caps else None
        found = linprog(
            -powers[0][-1],
            A_ub=upper,
            b_ub=right,
            A_eq=np.vstack([powers[order][-1] for order in (1, 2, 3)]),
            b_eq=np.zeros(3),
            bounds=[(-bounds[3], bounds[3])] * count,
            method="highs",
        )
        return -found.fun

    low, high = 0.5 * symmetric_time(angle, bounds), symmetric_time(angle, bounds) * 1.01
    for _ in range(14):
        middle = (low + high) / 2
        low, high = (middle, high) if reached(middle) < angle else (low, middle)
    return high


def test_where_all_limits_are_reached_the_symmetric_time_is_a_sum():
    """[Z2025]: 120° at 60 deg/s, 120 deg/s², 600 deg/s³, 6000 deg/s⁴ take 2 + 0.5 + 0.2 + 0.1 s."""
    bounds = tuple(b * DEG for b in (60, 120, 600, 6000))
    assert symmetric_time(120 * DEG, bounds) == pytest.approx(2.8, rel=1e-12)
    # the bound is less by a (j/s)²/12w = 120 · 0.01/720 s
    assert limit(120 * DEG, bounds) == pytest.approx(2.8 - 0.0016666667, rel=1e-9)


@pytest.mark.parametrize("seed", range(40))
def test_with_three_bounds_the_symmetric_profile_is_the_double_s(seed):
    rng = np.random.default_rng(seed)
    bounds, angle = random_bounds(rng)[:3], float(10 ** rng.uniform(-3, 0.5))
    assert symmetric_time(angle, bounds) == pytest.approx(double_s_time(angle, *bounds), rel=1e-9)


@pytest.mark.parametrize("seed", range(40))
def test_the_limit_lies_between_the_double_s_and_the_symmetric_profile(seed):
    rng = np.random.default_rng(seed)
    bounds, angle = random_bounds(rng), float(10 ** rng.uniform(-3, 0.5))
    found = limit(angle, bounds)
    least, most = double_s_time(angle, *bounds[:3]), symmetric_time(angle, bounds)
    assert least * (1 - 1e-12) <= found <= most * (1 + 1e-9)
    assert found >= 0.92 * most
    c = float(10 ** rng.uniform(-1, 1))
    faster = tuple(bound * c**k for k, bound in enumerate(bounds, 1))
    assert limit(angle, faster) == pytest.approx(found / c, rel=1e-9)


def test_snap_alone_is_the_perfect_spline():
    assert limit(2.0, (1e6, inf, inf, 15.0)) == pytest.approx((384 * 2 / 15) ** 0.25, rel=1e-6)


@pytest.mark.parametrize(
    "bounds",
    [
        (1.0, 2.0, 10.0, 40.0),
        pytest.param((1.0, inf, inf, 30.0), marks=pytest.mark.campaign),
        pytest.param((inf, inf, 10.0, 20.0), marks=pytest.mark.campaign),
        (1e3, 1e3, 1e3, 15.0),
    ],
)
def test_no_motion_of_piecewise_constant_snap_beats_the_limit(bounds):
    """Among thousands of switches, linear programs find none faster; they come between it and the symmetric one."""
    least = sampled_least_time(2.0, bounds)
    assert limit(2.0, bounds) <= least * (1 + 2e-3)
    assert least <= symmetric_time(2.0, bounds) * (1 + 2e-3)


@pytest.mark.parametrize(
    ("degree", "bounds"),
    [(21, (1e3, 1e3, 1e3, 15.0)), (13, (1.0, 2.0, 10.0, 100.0)), (21, (0.5, 1.0, 5.0, 20.0))],
)
def test_laws_under_snap_are_not_faster_than_the_limit(degree, bounds):
    given = dict(zip(NAMES, bounds, strict=True))
    found = solve_run(RunProblem(demands((2.0,), given), PolynomialFamily(degree, 3)))
    assert found.duration >= limit(2.0, bounds)
    assert found.duration <= 1.12 * limit(2.0, bounds)


def test_the_symmetric_profile_is_no_limit_a_spline_is_faster():
    """What [Z2025] gives is attained, but where snap alone binds an asymmetric ramp takes 4 % less."""
    bounds = (1e3, 1e3, 1e3, 15.0)
    given = dict(zip(NAMES, bounds, strict=True))
    found = solve_run(RunProblem(demands((2.0,), given), SplineFamily(5, 60, 3)))
    assert limit(2.0, bounds) <= found.duration < 0.96 * symmetric_time(2.0, bounds)
