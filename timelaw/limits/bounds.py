"""Bounds as files give them: one on a norm, or three for the body axes."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from timelaw.numerics.array import Array

AXES = ("x", "y", "z")

Bounds = float | tuple[float, float, float]


def least_quotient(bounds: tuple[float, float, float], components: Array) -> Array:
    """min_i bound_i/|component_i| over the body axes, shape (..., 3) → (...); zero ones do not bound."""
    with np.errstate(divide="ignore"):
        return np.asarray(np.min(np.array(bounds) / np.abs(components), axis=-1))


def write_bounds(limits: Mapping[str, Bounds]) -> dict[str, Any]:
    """Limits as a law file has them."""
    return {name: list(bounds) if isinstance(bounds, tuple) else bounds for name, bounds in limits.items()}


def read_bounds(limits: Mapping[str, Any]) -> dict[str, Bounds]:
    """Limits from a law file."""
    return {name: (b[0], b[1], b[2]) if isinstance(b, list) else float(b) for name, b in limits.items()}
