"""The angle that changing speed takes, against closed forms and a linear program of the whole motion."""

from math import inf

import numpy as np
import pytest
from scipy.optimize import linprog

from timelaw.least_time.braking import changing_distance, stopping_distance

STEPS = 80


def least_angle(start, end, a, j, time):
    """Least angle in a given time, by a linear program over the jerk of each step; inf if there is none."""
    dt = time / STEPS
    alpha = np.tril(np.ones((STEPS, STEPS))) * dt
    before = np.vstack([np.zeros(STEPS), alpha[:-1]])
    gained = np.tril(np.ones((STEPS, STEPS))) @ (before * dt + np.eye(STEPS) * dt**2 / 2)
    since = np.vstack([np.zeros(STEPS), gained[:-1]])
    travelled = (since * dt + before * dt**2 / 2 + np.eye(STEPS) * dt**3 / 6).sum(axis=0)
    bounded = [alpha, -alpha] if a < inf else []
    found = linprog(
        travelled,
        A_ub=np.vstack([*bounded, -gained]),
        b_ub=np.r_[np.full(len(bounded) * STEPS, a if a < inf else 0.0), np.full(STEPS, start)],
        A_eq=np.vstack([alpha[-1], gained[-1]]),
        b_eq=[0.0, end - start],
        bounds=(-j, j),
    )
    return start * time + found.fun if found.status == 0 else inf


@pytest.mark.parametrize(
    ("start", "end", "a", "j"),
    [(2.0, 1.0, inf, 3.0), (1.0, 2.0, 0.9, 3.0), (0.1, 2.0, inf, 3.0), (2.0, 0.5, 0.4, 3.0), (2.0, 0.0, 5.0, 3.0)],
)  # fmt: skip
def test_no_motion_that_never_turns_back_changes_speed_in_less(start, end, a, j):
    needed = changing_distance(start, end, a, j)
    quickest = 2 * (abs(end - start) / j) ** 0.5
    least = min(least_angle(start, end, a, j, t) for t in quickest * np.linspace(1.0, 8.0, 57))
    assert needed <= least * (1 + 1e-6)
    assert needed == pytest.approx(least, rel=2e-2)


def test_speeds_that_are_kept_take_no_angle():
    assert changing_distance(2.0, 2.0, 1.0, 3.0) == pytest.approx(0.0, abs=1e-2)
    assert changing_distance(0.0, 0.0, 1.0, inf) == 0.0


def test_braking_takes_what_constant_deceleration_and_constant_jerk_take():
    assert changing_distance(1.0, 2.0, 4.0, inf) == pytest.approx(3 / 8, rel=1e-3)
    assert stopping_distance(2.0, 4.0, inf) == 0.5
    t = np.linspace(0, (2 * 2.0 / 3.0) ** 0.5, 100001)
    assert stopping_distance(2.0, inf, 3.0) == pytest.approx(np.trapezoid(2.0 - 3.0 * t**2 / 2, t), rel=1e-9)
