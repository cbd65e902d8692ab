"""Limits as formulas in the vectors ω, α, jerk and snap, whatever their components are.

Components may be numbers, arrays over time, polynomials or exact fractions: whatever knows + and ×.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

Vector = Sequence[Any]  # three components in body axes
ZERO: Vector = (0.0, 0.0, 0.0)
Rates = Mapping[int, Vector]  # by order: 1 ω, 2 α, 3 jerk, 4 snap; what LINEAR names besides
LINEAR = {1: -1, 2: -2, 3: -3}  # keys of the derivatives of the origin's place, in world axes, by order


@dataclass(frozen=True)
class Formula:
    """|value| ≤ bound at every instant; `value` is the `root`-th power of what `label` names."""

    label: str
    value: Any
    bound: float
    root: int = 1


def add(u: Vector, v: Vector) -> list[Any]:
    """U + v."""
    return [a + b for a, b in zip(u, v, strict=True)]


def subtract(u: Vector, v: Vector) -> list[Any]:
    """U - v."""
    return [a + b * -1 for a, b in zip(u, v, strict=True)]


def dot(u: Vector, v: Vector) -> Any:
    """U · v."""
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u: Vector, v: Vector) -> list[Any]:
    """U × v."""
    return [u[i] * v[j] + u[j] * v[i] * -1 for i, j in ((1, 2), (2, 0), (0, 1))]


def apply(matrix: Sequence[Sequence[Any]], v: Vector) -> list[Any]:
    """J v."""
    return [v[0] * row[0] + v[1] * row[1] + v[2] * row[2] for row in matrix]


def product(p: Sequence[Any], q: Sequence[Any]) -> list[Any]:
    """Hamilton's product p ⊗ q of four components each."""
    across = cross(p[1:], q[1:])
    scalar = p[0] * q[0] + dot(p[1:], q[1:]) * -1
    return [scalar, *(p[0] * q[i + 1] + q[0] * p[i + 1] + across[i] for i in range(3))]


def conjugate(q: Sequence[Any]) -> list[Any]:
    """Q̄."""
    return [q[0], *(part * -1 for part in q[1:])]


def dot4(p: Sequence[Any], q: Sequence[Any]) -> Any:
    """The inner product of four components each."""
    return p[0] * q[0] + dot(p[1:], q[1:])
