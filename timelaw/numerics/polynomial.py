"""Polynomials on [0, 1] as values with operators: Bernstein control points and a bound on their rounding."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from math import comb
from typing import Any

import numpy as np

from timelaw.numerics.array import Array, freeze
from timelaw.numerics.ball import ABOVE, Ball
from timelaw.numerics.bernstein import UNIT_ROUNDOFF, elevate, evaluate, halving_matrix
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

    @classmethod
    def enclose_all(cls, functions: Sequence["Polynomial"]) -> list[Peak]:
        """Max |p| of each on [0, 1], its rounding in the upper bound."""
        tops = enclose_polynomials([p.control for p in functions])
        return [Peak(top.lower, top.upper + p.error, top.at) for top, p in zip(tops, functions, strict=True)]


@dataclass(frozen=True)
class PolynomialStack:
    """Polynomials of one form: control points (m, n+1), each within its row's `error` (m,) of the exact one.

    The operators of a single one, with the same bounds, for all at once; numbers (m,) multiply row by row.
    """

    control: Array
    error: Array

    @property
    def degree(self) -> int:
        """Degree n of the form."""
        return int(self.control.shape[-1]) - 1

    @cached_property
    def size(self) -> Array:
        """Largest control points (m,), bounds on |p|."""
        return _measure(self.control)

    def list_rows(self) -> list[Polynomial]:
        """One by one."""
        return [Polynomial(row, error) for row, error in zip(self.control, self.error.tolist(), strict=True)]

    @classmethod
    def join(cls, stacks: "Sequence[PolynomialStack]") -> "PolynomialStack":
        """The rows of all, of one form."""
        return cls(np.concatenate([s.control for s in stacks]), np.concatenate([s.error for s in stacks]))

    def take(self, rows: Any) -> "PolynomialStack":
        """Those of some rows, by number or mask."""
        return PolynomialStack(self.control[rows], self.error[rows])

    def raised(self, degree: int) -> "PolynomialStack":
        """The same polynomials in a form of a degree that is not lower."""
        if self.degree == degree:
            return self
        rounding = 4 * degree * UNIT_ROUNDOFF * self.size
        return PolynomialStack(elevate(self.control, degree), self.error + rounding)

    def halve(self) -> "PolynomialStack":
        """Those (2m) on [0, 1/2] and on [1/2, 1], each over [0, 1]; both halves of one after each other."""
        count = self.degree + 1
        both = self.control @ halving_matrix(self.degree).T
        error = self.error + 2 * (count + 1) * UNIT_ROUNDOFF * self.size
        return PolynomialStack(both.reshape(-1, count), np.repeat(error, 2))

    def derive(self) -> "PolynomialStack":
        """d/du, of degree 0 where there is nothing left."""
        if not self.degree:
            return PolynomialStack(np.zeros_like(self.control), np.zeros_like(self.error))
        control = np.diff(self.control) * float(self.degree)
        rounding = 8 * UNIT_ROUNDOFF * _measure(control)
        return PolynomialStack(control, 2 * self.error * self.degree * ABOVE + rounding)

    def __add__(self, other: "PolynomialStack | float") -> "PolynomialStack":
        if not isinstance(other, PolynomialStack):
            other = PolynomialStack(
                np.full((len(self.control), 1), float(other)), np.zeros(len(self.control))
            )
        degree = max(self.degree, other.degree)
        one, two = self.raised(degree), other.raised(degree)
        control = one.control + two.control
        return PolynomialStack(control, one.error + two.error + 2 * UNIT_ROUNDOFF * _measure(control))

    def __mul__(self, other: "PolynomialStack | Ball | Array | float") -> "PolynomialStack":
        if isinstance(other, Ball):
            exact = self * other.value
            return PolynomialStack(
                exact.control, exact.error + other.error * (self.size + self.error) * ABOVE
            )
        if not isinstance(other, PolynomialStack):
            factor = np.asarray(other, dtype=float)
            control = self.control * factor[..., None]
            carried = self.error * np.abs(factor) * (1 + SCALAR_ROUNDING)
            return PolynomialStack(control, carried + SCALAR_ROUNDING * _measure(control))
        m, n = self.degree, other.degree
        control = _convolve(self.control * _binomials(m), other.control * _binomials(n)) / _binomials(m + n)
        rounding = 2 * (min(m, n) + 6) * UNIT_ROUNDOFF * self.size * other.size
        carried = self.error * other.size + other.error * self.size + self.error * other.error
        return PolynomialStack(control, rounding + carried)

    __radd__ = __add__
    __rmul__ = __mul__


def _measure(control: Array) -> Array:
    return np.asarray(np.max(np.abs(control), axis=-1))


def _convolve(one: Array, two: Array) -> Array:
    """The convolutions (m, p+q-1) of rows (m, p) and (m, q)."""
    longer, shorter = (one, two) if one.shape[-1] >= two.shape[-1] else (two, one)
    width = longer.shape[-1]
    total = np.zeros((len(longer), width + shorter.shape[-1] - 1))
    for k in range(shorter.shape[-1]):
        total[:, k : k + width] += longer * shorter[:, k, None]
    return total
