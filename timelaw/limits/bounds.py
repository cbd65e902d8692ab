"""Bounds as files give them: one on a norm, or three for the body axes."""

import numpy as np

from timelaw.numerics.array import Array

AXES = ("x", "y", "z")

Bounds = float | tuple[float, float, float]


def least_quotient(bounds: tuple[float, float, float], components: Array) -> Array:
    """min_i bound_i/|component_i| over the body axes, shape (..., 3) → (...); zero ones do not bound."""
    with np.errstate(divide="ignore"):
        return np.asarray(np.min(np.array(bounds) / np.abs(components), axis=-1))
