"""Limits on ω, α and jerk as the search sees them: parts that are used, and how much slower would do."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from timelaw.numerics.array import Array
from timelaw.through.curve import Curve
from timelaw.through.turning_rows import make_basis, measure_rates

SAMPLES = 61  # places of a piece at which the search looks; what is proved is proved afterwards
ORDERS = (1, 2, 3)


@dataclass(frozen=True)
class RateLimits:
    """By order 1 ω, 2 α, 3 jerk: a bound on the norm, () or three for the body axes (3,), in SI."""

    bounds: Mapping[int, Array]

    def used(self, rates: Array, steps: Array) -> Array:
        """The part (p, m, 3) of each limit, to the power 1/k of its time, of rates X (p, m, 3, 3)."""
        found = np.zeros(rates.shape[:3])
        for k, bound in self.bounds.items():
            own = rates[:, :, k - 1] / steps[:, None, None] ** k
            part = (
                np.max(np.abs(own) / bound, axis=-1) if bound.ndim else np.linalg.norm(own, axis=-1) / bound
            )
            found[:, :, k - 1] = part ** (1 / k)
        return found


def sample_used(curve: Curve, limits: RateLimits, samples: int = SAMPLES) -> Array:
    """The used parts (p, m, 3) on a grid."""
    basis = make_basis(curve.degree, np.linspace(0.0, 1.0, samples))
    return limits.used(measure_rates(curve.control(), basis), curve.steps)


def find_stretch(curve: Curve, limits: RateLimits, samples: int = SAMPLES) -> Array:
    """By which factor (K,) each leg by itself would have to be slower to hold the limits on a grid."""
    used = np.max(sample_used(curve, limits, samples), axis=(1, 2))
    return np.array(np.max(used.reshape(-1, curve.pieces), axis=1))
