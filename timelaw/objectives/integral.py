"""Efforts of given timings, exact up to rounding."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from timelaw.easing import Timing
from timelaw.limits import Demand
from timelaw.objectives.objective import EFFORTS

NODES = 64  # Gauss-Legendre is exact up to degree 127, the fourth power of a slope of degree 31 is of 120


def effort_of(name: str, demands: Sequence[Demand], timings: Sequence[Timing]) -> float:
    """∫ g dt of an effort over legs run through as given."""
    effort, result = EFFORTS[name], 0.0
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    for demand, timing in zip(demands, timings, strict=True):
        for left, right in pairwise(timing.easing.breaks.tolist()):
            tau = left + (right - left) * (nodes + 1) / 2
            rates = {k: demand.angle / timing.duration**k * timing.easing(tau, k) for k in effort.orders}
            g = effort.integrand(demand, rates)
            result += float(np.sum(weights / 2 * g)) * timing.duration * (right - left)
    return result
