"""One curve: where the body is and how it turns along the curve's own parameter u, whatever the time.

With D = Q·Q the rate along u is Ω = 2 Vec(Q̄ Q')/D; at u' = du/dt the body turns with ω = Ω u' [HZ2019].
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np

from timelaw.numerics.array import Array, freeze
from timelaw.numerics.bernstein import differentiate, evaluate
from timelaw.numerics.composition import multiply_control
from timelaw.numerics.quaternion import conjugate, multiply


@dataclass(frozen=True)
class Curve:
    """Q by its `control` (n+1, 4), the origin's place by `points` (m+1, 3), over |Q|² if it is `divided`."""

    origin: str
    target: str
    control: Array
    points: Array | None = None
    divided: bool = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "control", freeze(self.control))
        if self.points is not None:
            object.__setattr__(self, "points", freeze(self.points))

    @property
    def name(self) -> str:
        """How reports call it."""
        return f"{self.origin}–{self.target}"

    @property
    def degree(self) -> int:
        """Of Q."""
        return len(self.control) - 1

    @cached_property
    def square(self) -> Array:
        """Control points (2n+1,) of |Q|²."""
        squares = [multiply_control(part, part) for part in self.control.T]
        return np.asarray(np.sum(squares, axis=0), dtype=float)

    @cached_property
    def numerator(self) -> Array | None:
        """Control points (·, 3) of the polynomial that gives the place when it is divided by |Q|²."""
        if self.points is None or self.divided:
            return self.points
        return multiply_control(self.square, self.points).astype(float)

    def orientation(self, u: Array) -> Array:
        """Unit quaternions (m, 4) at u (m,)."""
        q = evaluate(self.control.T, np.asarray(u, dtype=float)[..., None])
        return np.array(q / np.linalg.norm(q, axis=-1, keepdims=True))

    def turning(self, u: Array, highest: int) -> list[Array]:
        """Ω and its first derivatives along u, `highest` rates (m, 3) in all, in body axes."""
        q = [self._derive(self.control, u, k) for k in range(highest + 1)]
        square = [_mix(lambda i, j: np.sum(q[i] * q[j], axis=-1), k) for k in range(highest)]
        found: list[Array] = []
        for k in range(highest):
            value = 2 * _mix(lambda i, j: multiply(conjugate(q[i]), q[j + 1])[..., 1:], k)
            found.append(_solve(value, found, square))
        return found

    def place(self, u: Array, highest: int) -> list[Array]:
        """The origin's place and its first derivatives along u, highest + 1 vectors (m, 3) in the world."""
        if self.points is None:
            return [np.zeros((*np.shape(u), 3)) for _ in range(highest + 1)]
        values = [self._derive(self.points, u, k) for k in range(highest + 1)]
        if not self.divided:
            return values
        q = [self._derive(self.control, u, k) for k in range(highest + 1)]
        square = [_mix(lambda i, j: np.sum(q[i] * q[j], axis=-1), k) for k in range(highest + 1)]
        found: list[Array] = []
        for value in values:
            found.append(_solve(value, found, square))
        return found

    @staticmethod
    def _derive(control: Array, u: Array, order: int) -> Array:
        return evaluate(differentiate(control.T, order), np.asarray(u, dtype=float)[..., None])


def _mix(product: Callable[[int, int], Array], order: int) -> Array:
    """The k-th derivative of a product of derivatives, by Leibniz' rule."""
    return np.asarray(sum(comb(order, i) * product(i, order - i) for i in range(order + 1)))


def _solve(value: Array, lower: list[Array], square: list[Array]) -> Array:
    """The k-th derivative of N/D from that of N, the lower ones, and those of D."""
    k = len(lower)
    for i, known in enumerate(lower):
        value = value - comb(k, i) * known * square[k - i][..., None]
    return np.asarray(value / square[0][..., None])
