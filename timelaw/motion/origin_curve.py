"""Where the body's origin is on a piece of a rational segment: c = P/|Q|², as numbers and polynomials.

With D = Q·Q the k-th numerator Y_k, by Y_0 = P and Y_(k+1) = Y_k' D - (k+1) Y_k D' in u = t/h, is the k-th
derivative of c times h^k D^(k+1) [HZ2019]. P may have any degree: 2d where its control points are those of a
path without |Q|² times |Q|², which divides out again.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb

import numpy as np

from timelaw.limits.formula import LINEAR, Vector
from timelaw.motion.curve_form import CurveForm
from timelaw.motion.quaternion_curve import QuaternionCurve
from timelaw.numerics.array import Array, freeze
from timelaw.numerics.bernstein import differentiate, evaluate
from timelaw.numerics.polynomial import Polynomial, PolynomialStack

HIGHEST_LIMITED = 2  # derivative of the origin's place that a limit may bound


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
            value = evaluate(differentiate(self._level.T, k) / h**k, u[..., None])
            with np.errstate(divide="ignore", invalid="ignore"):  # where Q vanishes there is no place
                for i, lower in enumerate(found):
                    value = value - comb(k, i) * lower * square[k - i][..., None]
                found.append(value / square[0][..., None])
        return found[-1]

    @property
    def _level(self) -> Array:
        """Points over the power of two by which the control points of Q are smaller, twice."""
        return np.asarray(np.ldexp(self.points, -2 * self.turn.exponent))

    def restrict(self, start: float, end: float) -> list[Polynomial]:
        """P (3) on one of the parts that halving makes."""
        return [_restrict(Polynomial(column), start, end) for column in self._level.T]


def derive_origins(origins: Sequence[OriginCurve], form: CurveForm) -> dict[int, Vector]:
    """By their keys in limits hY_k (3) on parts of pieces: the k-th derivative is hY_k/(hD)^(k+1)."""
    whole = zip(form.piece.tolist(), form.start.tolist(), form.end.tolist(), strict=True)
    rows = [origins[k].restrict(start, end) for k, start, end in whole]
    degree = max(part.degree for row in rows for part in row)
    parts = [_stack([part.raised(degree) for part in column]) for column in zip(*rows, strict=True)]
    faster = 1 / (form.end - form.start)  # a power of two
    found: dict[int, Vector] = {}
    for k in range(HIGHEST_LIMITED):
        parts = [p.derive() * faster * form.square + p * form.slope * -(k + 1.0) for p in parts]
        found[LINEAR[k + 1]] = [part * form.duration for part in parts]
    return found


def _stack(parts: Sequence[Polynomial]) -> PolynomialStack:
    return PolynomialStack(np.stack([p.control for p in parts]), np.array([p.error for p in parts]))


def _restrict(whole: Polynomial, start: float, end: float) -> Polynomial:
    """A polynomial on one of the parts that halving makes."""
    low, high = 0.0, 1.0
    while (low, high) != (start, end):
        middle = (low + high) / 2
        left, right = whole.halve()
        whole, low, high = (left, low, middle) if end <= middle else (right, middle, high)
    return whole
