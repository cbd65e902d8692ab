"""Efforts of a motion: the integral of the square of a rate, infinite where a lower rate jumps."""

from math import inf

import numpy as np

from timelaw.certificate.continuity import Continuity
from timelaw.motion import QuaternionLaw


def measure_effort(law: QuaternionLaw, continuity: Continuity, order: int) -> float:
    """∫ |k-th rate|² dt over the motion, exact: k = 3 is the smoothness ∫|jerk|² dt [rad²/s⁵].

    Where the rate before jumps, the k-th is a pulse without bound, and so is the integral of its square.
    """
    if continuity.order < order - 1:
        return inf
    return sum(
        rate.integrate_square() * float(width) * segment.duration
        for segment in law.segments
        for rate, width in zip(segment.rates(order), np.diff(segment.breaks), strict=True)
    )
