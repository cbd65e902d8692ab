"""Rates of a body that runs along a curve, from u, u', … at instants, and what of the limits they use.

With X' = Ω for the rotation or the first derivative of the place along u, the rates in time are
X'u', X''u'² + X'u'', X'''u'³ + 3X''u'u'' + X'u''', X⁗u'⁴ + 6X'''u'²u'' + X''(3u''² + 4u'u''') + X'u⁗.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from timelaw.bezier.curve import Curve
from timelaw.limits import Bounds, Limit, make_limits
from timelaw.limits.body import RigidBody
from timelaw.limits.formula import LINEAR, Formula, Vector
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import rotation_matrix
from timelaw.through.dual import Dual, seed

STATES = 5  # u and four derivatives
MOST_LINEAR = 2  # derivative of the place that a limit may bound


@dataclass(frozen=True)
class Split:
    """A limit by its three components, each over a bound; of a norm if not `by_axis`."""

    limit: Limit
    by_axis: bool


def split_limits(given: Mapping[str, Bounds], body: RigidBody | None) -> tuple[Split, ...]:
    """Limits with what is limited as vectors, whose sizes or components are bounded."""
    parts = {name: b if isinstance(b, tuple) else (b, b, b) for name, b in given.items()}
    made = make_limits(parts, body)
    return tuple(Split(limit, isinstance(given[limit.name], tuple)) for limit in made)


def measure_parts(curve: Curve, limits: Sequence[Split], states: Array, total: Array) -> Array:
    """Vectors over their bounds (l, 3, m) at states (m, 5) of u; `total` is H (3,) in the world."""
    columns = list(states.T)
    still = 0 * columns[0]
    formulas = _expand(curve, limits, columns, states[:, 0], total)
    return np.stack([np.stack([f.value / f.bound + still for f in own]) for own in formulas])


def derive_parts(curve: Curve, limits: Sequence[Split], states: Array, total: Array) -> tuple[Array, Array]:
    """The same, and their slopes (l, 3, m, 5) by the states."""
    formulas = _expand(curve, limits, seed(states, 0, STATES), states[:, 0], total)
    values = np.stack([np.stack([f.value.value / f.bound for f in own]) for own in formulas])
    return values, np.stack([np.stack([f.value.slope / f.bound for f in own]) for own in formulas])


def list_used(parts: Array, limits: Sequence[Split]) -> Array:
    """What part of each limit is used (l, m): a norm, or the largest component."""
    by_axis = np.array([limit.by_axis for limit in limits])[:, None]
    return np.asarray(np.where(by_axis, np.max(np.abs(parts), axis=1), np.linalg.norm(parts, axis=1)))


def _expand(
    curve: Curve, limits: Sequence[Split], states: Sequence[Any], u: Array, total: Array
) -> list[Sequence[Formula]]:
    """Each limit's three formulas, their values of the kind of the states."""
    highest = max((split.limit.highest for split in limits), default=0)
    x = curve.turning(u, highest + 2)
    vectors = [_follow(states[0], x[k], x[k + 1]) for k in range(highest + 1)]
    rates = _chain(vectors, states, highest)
    if curve.points is not None:
        places = curve.place(u, MOST_LINEAR + 1)
        moved = [_follow(states[0], places[k], places[k + 1]) for k in range(1, MOST_LINEAR + 1)]
        rates |= {LINEAR[k]: vector for k, vector in _chain(moved, states, MOST_LINEAR).items()}
    seen = _turn_back(curve, states[0], u, x[0], total)
    return [split.limit.of(rates, seen) for split in limits]


def _follow(first: Any, value: Array, slope: Array) -> list[Any]:
    """A vector (m, 3) at u as three components that know how they change with u, if states know theirs."""
    if not isinstance(first, Dual):
        return list(value.T)
    return [Dual(v, s[:, None] * first.slope) for v, s in zip(value.T, slope.T, strict=True)]


def _chain(x: Sequence[Vector], states: Sequence[Any], highest: int) -> dict[int, Vector]:
    """Rates in time by order."""
    _, p, a, j, s = states
    factors: list[list[Any]] = [
        [p],
        [a, p * p],
        [j, p * a * 3.0, p * p * p],
        [s, p * j * 4.0 + a * a * 3.0, p * p * a * 6.0, p * p * p * p],
    ]
    terms = {k: [[f * part for part in x[i]] for i, f in enumerate(factors[k])] for k in range(highest)}
    columns = {k: zip(*own, strict=True) for k, own in terms.items()}
    return {k + 1: [sum(parts[1:], parts[0]) for parts in own] for k, own in columns.items()}


def _turn_back(curve: Curve, first: Any, u: Array, omega: Array, total: Array) -> Vector:
    """A vector of the world in body axes; along u it turns by -Ω × H."""
    if not np.any(total):
        return (0.0, 0.0, 0.0)
    seen = np.einsum("mij,i->mj", rotation_matrix(curve.orientation(u)), total)
    return _follow(first, seen, np.cross(seen, omega))
