"""Polynomials on [0, 1] as values with operators: Bernstein control points and a bound on their rounding."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.ball import ABOVE, Ball
from timelaw.numerics.bernstein import UNIT_ROUNDOFF, elevate, evaluate, integrate_square
from timelaw.numerics.extrema import Peak, enclose_polynomials

SCALAR_ROUNDING = 16 * UNIT_ROUNDOFF  # scalars are powers and quotients, themselves rounded a few times


@dataclass(frozen=True)
class Polynomial:
    """Control points (n+1,), each within `error` of the exact one.

    Sums, products and scalar multiples carry the bound along: u is the unit roundoff, an inner
    product of k terms errs by less than 2 k u times the sum of the sizes of its terms.
    """

    control: Array
    error: float = 0.0

    @property
    def degree(self) -> int:
        """Degree n of the form, not always of the polynomial."""
        return len(self.control) - 1

    @property
    def size(self) -> float:
        """Largest control point, a bound on |p|."""
        return float(np.max(np.abs(self.control)))

    def __add__(self, other: "Polynomial | float") -> "Polynomial":
        if not isinstance(other, Polynomial):
            other = Polynomial(np.array([float(other)]))
        degree = max(self.degree, other.degree)
        raised = sum(4 * degree * UNIT_ROUNDOFF * p.size for p in (self, other) if p.degree < degree)
        control = elevate(self.control, degree) + elevate(other.control, degree)
        rounding = 2 * UNIT_ROUNDOFF * float(np.max(np.abs(control)))
        return Polynomial(control, self.error + other.error + raised + rounding)

    def __mul__(self, other: "Polynomial | Ball | float") -> "Polynomial":
        if isinstance(other, Ball):
            exact = self * other.value
            return Polynomial(exact.control, exact.error + other.error * (self.size + self.error) * ABOVE)
        if not isinstance(other, Polynomial):
            control = self.control * other
            rounding = SCALAR_ROUNDING * float(np.max(np.abs(control)))
            return Polynomial(control, self.error * abs(other) * (1 + SCALAR_ROUNDING) + rounding)
        m, n = self.degree, other.degree
        left = self.control * [comb(m, i) for i in range(m + 1)]
        right = other.control * [comb(n, i) for i in range(n + 1)]
        control = np.convolve(left, right) / [comb(m + n, k) for k in range(m + n + 1)]
        rounding = 2 * (min(m, n) + 6) * UNIT_ROUNDOFF * self.size * other.size
        carried = self.error * other.size + other.error * self.size + self.error * other.error
        return Polynomial(control, rounding + carried)

    __radd__ = __add__
    __rmul__ = __mul__

    def __call__(self, u: Array) -> Array:
        """Values at u (m,)."""
        return evaluate(self.control, u)

    def integrate_square(self) -> float:
        """∫ p² du over [0, 1]."""
        return float(integrate_square(self.control))

    @classmethod
    def enclose_all(cls, functions: Sequence["Polynomial"]) -> list[Peak]:
        """Max |p| of each on [0, 1], its rounding in the upper bound."""
        tops = enclose_polynomials([p.control for p in functions])
        return [Peak(top.lower, top.upper + p.error, top.at) for top, p in zip(tops, functions, strict=True)]
