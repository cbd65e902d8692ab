"""Rates in world axes, as robots and some flight software take them; laws have theirs in body axes.

ω_world = R ω, and because ω×ω = 0 also α_world = R α is its derivative.
"""

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array


def turn_to_world(law: QuaternionLaw, t: Array, order: int) -> Array:
    """ω (order 1) or α (order 2) in world axes (m, 3) at the instants t (m,)."""
    return np.asarray(np.einsum("mij,mj->mi", law.rotation(t), law(t, order)))
