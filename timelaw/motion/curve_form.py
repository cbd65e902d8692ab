"""Q and its derivatives on a part of a piece as polynomials, and what limits are made of there.

Derivatives are in u = t/h, and Q is as large as one: no power of a short time or of a small Q leaves the
range of doubles. With D = Q·Q, v(a, b) = Vec(ā b) and N = 2 v(Q, Q') the k-th rate is X_k/(hD)^k [HZ2019],
by Leibniz' rule in N = ω D: X_(k+1) = N^(k) D^k - Σ C(k, i) X_(i+1) D^(k-i-1) (d/du)^(k-i) D for i < k.
Derivatives of N and D are made of those of Q: differences of products would lose what is small beside them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import comb
from typing import Any

import numpy as np
from numpy.typing import NDArray

from timelaw.limits import Limit
from timelaw.limits.formula import Vector, conjugate, cross, dot, dot4, product
from timelaw.numerics.array import Array
from timelaw.numerics.polynomial import PolynomialStack
from timelaw.numerics.quotient import Quotient, divide

EVEN = 2.0  # times the least control point of D is the largest at most; else powers of D drown in rounding
DEPTH = 24  # halvings; a Q that is ten million times smaller there than its control points can be told from 0

Quaternion = list[PolynomialStack]
Index = NDArray[np.int64]


@dataclass(frozen=True)
class CurveForm:
    """Parts (m) of pieces of one degree: of each the number of the `piece`, its duration h [s], where it is.

    u goes from `start` to `end`; Q^(j) (4) = `derivatives`[j] of all parts at once.
    """

    piece: Index
    duration: Array
    start: Array
    end: Array
    derivatives: tuple[Quaternion, ...]

    def split(self) -> "CurveForm":
        """Parts on which D is even enough, or lost in rounding at an end; in the order of time."""
        done, rest = [], self
        for _ in range(DEPTH):
            uneven = rest._find_uneven()
            if not np.any(uneven):
                break
            done.append(rest._take(~uneven))
            rest = rest._take(uneven)._halve()
        return _join([*done, rest]) if done else self

    def _find_uneven(self) -> NDArray[np.bool_]:
        control = self.square.control
        lost = np.minimum(control[:, 0], control[:, -1]) <= self.square.error
        even = np.max(control, axis=1) <= EVEN * np.min(control, axis=1)
        return np.asarray(~(lost | even))

    def _take(self, rows: NDArray[np.generic]) -> "CurveForm":
        own = tuple([part.take(rows) for part in q] for q in self.derivatives)
        return CurveForm(self.piece[rows], self.duration[rows], self.start[rows], self.end[rows], own)

    def _halve(self) -> "CurveForm":
        middle = (self.start + self.end) / 2
        return CurveForm(
            np.repeat(self.piece, 2),
            np.repeat(self.duration, 2),
            np.column_stack([self.start, middle]).ravel(),
            np.column_stack([middle, self.end]).ravel(),
            tuple([part.halve() for part in q] for q in self.derivatives),
        )

    @cached_property
    def square(self) -> PolynomialStack:
        """D, of degree 2d."""
        total: PolynomialStack = dot4(self.derivatives[0], self.derivatives[0])
        return total

    @property
    def slope(self) -> PolynomialStack:
        """D' in u."""
        return self._squares[1]

    def power(self, exponent: int) -> PolynomialStack:
        """(h D)^exponent."""
        return _raise(self._scaled_powers, exponent)

    def numerators(self, highest: int) -> dict[int, Vector]:
        """X_k (3) for k = 1 … `highest`: ω = X_1/hD, α = X_2/(hD)², jerk = X_3/(hD)³, snap = X_4/(hD)⁴."""
        known = self._numerators
        for k in range(len(known), highest):
            found = derive_turning(self.derivatives, k)
            if k:
                found = [part * _raise(self._powers, k) for part in found]
            for i in range(k):
                factor = self._squares[k - i] * -float(comb(k, i))
                if k - i > 1:
                    factor = factor * _raise(self._powers, k - i - 1)
                found = [a + b * factor for a, b in zip(found, known[i + 1], strict=True)]
            known[k + 1] = found
        return {k: known[k] for k in range(1, highest + 1)}

    def measure_rate(self, order: int) -> list[Quotient]:
        """The size of the k-th rate on each part: √(X_k·X_k/(hD)^2k)."""
        with np.errstate(over="ignore", invalid="ignore"):
            numerator = self.numerators(order)[order]
            return divide(dot(numerator, numerator), self.power(2 * order), 2)

    def divide_formulas(
        self, limits: Sequence[Limit], total: Vector, moved: Mapping[int, Vector]
    ) -> list[list[Quotient]]:
        """Every limit's own formulas in the numerators, over hD to the limit's power, on each part.

        `moved` are those of the body's origin.

        What is beyond doubles is not finite, and has no bound.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            rates = self.numerators(max([1, *(limit.highest for limit in limits)])) | dict(moved)
            seen = self.turn_back(total)
            return [
                divide(formula.value, self.power(limit.depth * formula.root))
                for limit in limits
                for formula in limit.of(rates, seen)
            ]

    def turn_back(self, vector: Vector) -> Vector:
        """A vector v (3) of the world in body axes, times hD: the vector part of Q̄ ⊗ (0, hv) ⊗ Q."""
        if not any(vector):
            return vector
        q = self.derivatives[0]
        turned = product(product(conjugate(q), [0.0, *vector]), q)[1:]
        return [part * self.duration for part in turned]

    @cached_property
    def _squares(self) -> list[PolynomialStack]:
        """D and its derivatives."""
        q = self.derivatives
        return [self.square, *(derive_square(q, order) for order in range(1, len(q) - 1))]

    @cached_property
    def _powers(self) -> dict[int, PolynomialStack]:
        return {1: self.square}

    @cached_property
    def _scaled_powers(self) -> dict[int, PolynomialStack]:
        return {1: self.square * self.duration}

    @cached_property
    def _numerators(self) -> dict[int, Vector]:
        return {}


def _join(forms: Sequence[CurveForm]) -> CurveForm:
    """Parts of all forms, piece by piece in the order of time."""
    piece, start = (np.concatenate([getattr(f, name) for f in forms]) for name in ("piece", "start"))
    order = np.lexsort((start, piece))
    derivatives = []
    for q in zip(*(f.derivatives for f in forms), strict=True):
        columns = zip(*q, strict=True)
        derivatives.append([PolynomialStack.join(parts).take(order) for parts in columns])
    duration, end = (np.concatenate([getattr(f, name) for f in forms]) for name in ("duration", "end"))
    return CurveForm(piece[order], duration[order], start[order], end[order], tuple(derivatives))


def _raise(known: dict[int, PolynomialStack], exponent: int) -> PolynomialStack:
    """A power of known[1], by halves."""
    if exponent not in known:
        half = exponent // 2
        known[exponent] = _raise(known, half) * _raise(known, exponent - half)
    return known[exponent]


def derive_turning(q: Sequence[Any], order: int) -> Vector:
    """The k-th derivative of N from Q and its derivatives, polynomials or values; v(a, b) = -v(b, a)."""
    terms = []
    for i in range((order + 2) // 2):
        weight = 2.0 * (comb(order, i) - (comb(order, i - 1) if i else 0))
        terms.append([part * weight for part in _turn(q[i], q[order + 1 - i])])
    return [sum(parts[1:], parts[0]) for parts in zip(*terms, strict=True)]


def derive_square(q: Sequence[Any], order: int) -> Any:
    """The k-th derivative of D from Q and its derivatives, polynomials or values."""
    terms = [dot4(q[i], q[order - i]) * float(comb(order, i)) for i in range(order + 1)]
    return sum(terms[1:], terms[0])


def _turn(p: Sequence[Any], q: Sequence[Any]) -> Vector:
    """v(p, q)."""
    across = cross(q[1:], p[1:])
    return [p[0] * q[i + 1] + q[0] * p[i + 1] * -1.0 + across[i] for i in range(3)]
