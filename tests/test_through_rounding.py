"""Rounding of control points: what it makes the rates of a curve jump by is below what is said of it."""

import numpy as np
import pytest

from tests.test_through import random_curve
from timelaw.limits import make_limits
from timelaw.through.measures import LimitMeasure
from timelaw.through.rounding import find_blur


def jerk_bound(bound, legs):
    (limit,) = make_limits({"jerk": bound}, None)
    return LimitMeasure(limit, np.full((legs, 1), bound), [0.0, 0.0, 0.0])


@pytest.mark.parametrize("seed", range(4))
def test_a_joints_jump_is_below_its_bound_and_not_far_below(seed):
    """The jerk on both sides of every knot, by differences of the control points in long double."""
    curve = random_curve(np.random.default_rng(seed), 6, 1, 8, 3).stretched(0.05)
    points = curve.control().astype(np.longdouble)
    h = np.longdouble(1) * curve.steps[:, None]

    def jerk(sign):
        q = points if sign > 0 else points[:, ::-1]
        d = [q[:, 0], 8 * (q[:, 1] - q[:, 0]) / h * sign, 56 * np.diff(q, 2, axis=1)[:, 0] / h**2]
        d.append(336 * np.diff(q, 3, axis=1)[:, 0] / h**3 * sign)
        return d

    before, after = jerk(-1), jerk(1)
    jump = max(
        float(np.max(np.linalg.norm(2 * (a[1:] - b[:-1]), axis=1))) for a, b in [(after[3], before[3])]
    )
    found = find_blur(curve, [jerk_bound(1.0, 6)])
    assert jump < found
    assert found < 100 * jump
