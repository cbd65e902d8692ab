"""Bounds as files give them: one on a norm, or three for the body axes."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from timelaw.limits.formula import Formula, Vector, dot
from timelaw.numerics.array import Array
from timelaw.numerics.ball import Number, list_numbers, measure

AXES = ("x", "y", "z")

Bounds = float | tuple[float, float, float]


def bound_vector(name: str, vector: Vector, bounds: Bounds) -> list[Formula]:
    """V · v ≤ w² for a norm, v_i ≤ w_i for three body axes."""
    if not isinstance(bounds, tuple):
        return [Formula(name, dot(vector, vector), bounds**2, root=2)]
    return [
        Formula(f"{name} {axis}", component, bound)
        for axis, component, bound in zip(AXES, vector, bounds, strict=True)
    ]


def split_by_axis(name: str, vector: Array, bounds: Bounds) -> Iterator[tuple[str, Number, float]]:
    """(label, factor, bound) of rows that limit a constant vector (3,) times a rate: its norm, or by axis.

    Factors are floats, or balls where the vector is made of them.
    """
    if not isinstance(bounds, tuple):
        yield name, measure(vector), bounds
        return
    for axis, component, bound in zip(AXES, list_numbers(vector), bounds, strict=True):
        yield f"{name} {axis}", component, bound


def least_quotient(bounds: Bounds, vectors: Array) -> Array:
    """Bound over norm, or min_i bound_i/|component_i|, (..., 3) → (...); zero components do not bound."""
    if not isinstance(bounds, tuple):
        return np.asarray(bounds / np.linalg.norm(vectors, axis=-1))
    with np.errstate(divide="ignore"):
        return np.asarray(np.min(np.array(bounds) / np.abs(vectors), axis=-1))


def lessen(bounds: Bounds, by: float) -> Bounds:
    """Each bound less a constant, rounded down."""
    if not by:
        return bounds
    less = np.nextafter(np.subtract(bounds, by), -np.inf)
    return (float(less[0]), float(less[1]), float(less[2])) if isinstance(bounds, tuple) else float(less)


def write_bounds(limits: Mapping[str, Bounds]) -> dict[str, Any]:
    """Limits as a law file has them."""
    return {name: list(bounds) if isinstance(bounds, tuple) else bounds for name, bounds in limits.items()}


def read_bounds(limits: Mapping[str, Any]) -> dict[str, Bounds]:
    """Limits from a law file."""
    return {name: (b[0], b[1], b[2]) if isinstance(b, list) else float(b) for name, b in limits.items()}
