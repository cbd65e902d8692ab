"""Where the body's origin is on a piece of a rational segment: c = P/|Q|², as numbers and polynomials.

With D = Q·Q the k-th numerator Y_k, by Y_0 = P and Y_(k+1) = Y_k' D - (k+1) Y_k D', is the k-th derivative
of c times D^(k+1) [HZ2019]. P may have any degree: 2d where its control points are those of a path without
|Q|² times |Q|², which divides out again.
"""

from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np

from timelaw.limits.formula import Vector
from timelaw.motion.quaternion_curve import QuaternionCurve
from timelaw.numerics.array import Array, freeze
from timelaw.numerics.bernstein import differentiate, evaluate
from timelaw.numerics.polynomial import Polynomial


@dataclass(frozen=True)
class OriginCurve:
    """One piece: P by its `points` (m+1, 3) over the time of its quaternion curve `turn`."""

    points: Array
    turn: QuaternionCurve

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", freeze(self.points))

    def __call__(self, u: Array, order: int) -> Array:
        """At u = t/h (m,): the place, velocity, acceleration, jerk (m, 3) in the world for order 0 to 3.

        The derivatives of P = c D by Leibniz' rule, solved for the highest of c.
        """
        h = self.turn.duration
        u = np.asarray(u, dtype=float)
        square = self.turn.squares(u, order)
        found: list[Array] = []
        for k in range(order + 1):
            value = evaluate(differentiate(self.points.T, k) / h**k, u[..., None])
            for i, lower in enumerate(found):
                value = value - comb(k, i) * lower * square[k - i][..., None]
            found.append(value / square[0][..., None])
        return found[-1]

    def numerators(self, highest: int) -> dict[int, Vector]:
        """Y_k (3) for k = 1 … `highest`: the k-th derivative is Y_k/D^(k+1)."""
        known, h = self._numerators, self.turn.duration
        slope = self.turn.square.derive(h)
        for k in range(len(known) - 1, highest):
            known[k + 1] = [p.derive(h) * self.turn.square + p * slope * -(k + 1.0) for p in known[k]]
        return {k: known[k] for k in range(1, highest + 1)}

    @cached_property
    def _numerators(self) -> dict[int, Vector]:
        return {0: [Polynomial(column) for column in self.points.T]}
