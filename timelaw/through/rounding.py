"""What the rounding of control points makes the rates of a curve jump by where its pieces meet."""

from collections.abc import Sequence
from math import perm

import numpy as np

from timelaw.limits.row import ORDERS
from timelaw.numerics.bernstein import UNIT_ROUNDOFF
from timelaw.through.curve import Curve
from timelaw.through.measures import LimitMeasure

TOLERABLE = 2e-9  # of a limit, as this bounds it; what happens is a third of it, and 1e-9 is a jump


def find_blur(curve: Curve, measures: Sequence[LimitMeasure]) -> float:
    """The largest jump that rounding may make, in parts of the limit on the rate of that order; 0 for none.

    The k-th derivative by time of Σ c_i B_i(t/h) errs by u 2^k n!/(n - k)!/h^k where each |c_i| errs by u;
    the rate has twice that.
    """
    worst = 0.0
    for measure in measures:
        order = ORDERS.get(measure.limit.name, 0)
        if 1 < order <= curve.smooth:
            error = UNIT_ROUNDOFF * 2 ** (order + 1) * perm(curve.degree, order) / curve.duration**order
            worst = max(worst, float(np.max(error / np.min(measure.bounds, axis=1))))
    return worst
