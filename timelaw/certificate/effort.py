"""Efforts of a motion: the integral of the square of a rate, infinite where a lower rate jumps."""

from itertools import pairwise
from math import inf

import numpy as np

from timelaw.certificate.continuity import Continuity
from timelaw.limits import make_limits
from timelaw.motion import QuaternionLaw
from timelaw.motion.segment import group_by_kind

NODES = 24  # of Gauss-Legendre's rule on each piece


def measure_torque(law: QuaternionLaw) -> float:
    """∫ |τ|² dt [N²·m²·s] over the motion, by quadrature; a body without total momentum is needed."""
    (limit,) = make_limits({"torque": 1.0}, law.body)
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    total = 0.0
    for segment in law.legs:
        for first, last in pairwise(segment.breaks.tolist()):
            tau = first + (last - first) * (nodes + 1) / 2
            rates = {order: list(segment(tau, order, "right").T) for order in (1, 2)}
            square = np.sum(np.square(limit.vector(rates)), axis=0)
            total += float(weights @ square) / 2 * (last - first) * segment.duration
    return total


def measure_effort(law: QuaternionLaw, continuity: Continuity, order: int) -> float:
    """∫ |k-th rate|² dt over the motion, exact: k = 3 is the smoothness ∫|jerk|² dt [rad²/s⁵].

    Where the rate before jumps, the k-th is a pulse without bound, and so is the integral of its square.
    """
    if continuity.order < order - 1:
        return inf
    kinds = group_by_kind(law.segments).items()
    return sum(kind.integrate_squares([law.segments[k] for k in numbers], order) for kind, numbers in kinds)
