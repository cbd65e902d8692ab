"""Polynomials on [0, 1] as values with operators: Bernstein control points and a bound on their rounding."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import comb

import numpy as np

from timelaw.numerics.array import Array, freeze
from timelaw.numerics.ball import ABOVE, Ball
from timelaw.numerics.bernstein import UNIT_ROUNDOFF, elevate, evaluate, halving_matrix, integrate_square
from timelaw.numerics.extrema import Peak, enclose_polynomials

SCALAR_ROUNDING = 16 * UNIT_ROUNDOFF  # scalars are powers and quotients, themselves rounded a few times


@cache
def _binomials(n: int) -> Array:
    """C(n, i) for i = 0 … n, each rounded once."""
    return freeze(np.array([comb(n, i) for i in range(n + 1)], dtype=float))


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

    @property
    def finite(self) -> bool:
        """Whether control points and their error are numbers within the range of doubles."""
        return bool(np.isfinite(self.error) and np.all(np.isfinite(self.control)))

    def raised(self, degree: int) -> "Polynomial":
        """The same polynomial in a form of a degree that is not lower; means of two, each rounded thrice."""
        if self.degree == degree:
            return self
        rounding = 4 * degree * UNIT_ROUNDOFF * self.size
        return Polynomial(elevate(self.control, degree), self.error + rounding)

    def halve(self) -> tuple["Polynomial", "Polynomial"]:
        """The same polynomial on [0, 1/2] and on [1/2, 1], both over [0, 1]."""
        count = self.degree + 1
        both = halving_matrix(self.degree) @ self.control
        error = self.error + 2 * (count + 1) * UNIT_ROUNDOFF * self.size
        return Polynomial(both[:count], error), Polynomial(both[count:], error)

    def derive(self, duration: float) -> "Polynomial":
        """d/dt, u = t/duration: n (c_(j+1) - c_j)/h, of degree 0 where there is nothing left."""
        if not self.degree:
            return Polynomial(np.zeros(1))
        factor = self.degree / duration
        control = np.diff(self.control) * factor
        rounding = 8 * UNIT_ROUNDOFF * float(np.max(np.abs(control)))
        return Polynomial(control, 2 * self.error * factor * ABOVE + rounding)

    def __add__(self, other: "Polynomial | float") -> "Polynomial":
        if not isinstance(other, Polynomial):
            other = Polynomial(np.array([float(other)]))
        degree = max(self.degree, other.degree)
        one, two = self.raised(degree), other.raised(degree)
        control = one.control + two.control
        rounding = 2 * UNIT_ROUNDOFF * float(np.max(np.abs(control)))
        return Polynomial(control, one.error + two.error + rounding)

    def __mul__(self, other: "Polynomial | Ball | float") -> "Polynomial":
        if isinstance(other, Ball):
            exact = self * other.value
            return Polynomial(exact.control, exact.error + other.error * (self.size + self.error) * ABOVE)
        if not isinstance(other, Polynomial):
            control = self.control * other
            rounding = SCALAR_ROUNDING * float(np.max(np.abs(control)))
            return Polynomial(control, self.error * abs(other) * (1 + SCALAR_ROUNDING) + rounding)
        m, n = self.degree, other.degree
        product = np.convolve(self.control * _binomials(m), other.control * _binomials(n))
        control = product / _binomials(m + n)
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
