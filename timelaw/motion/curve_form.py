"""Q and its derivatives on a part of a piece as polynomials, and what limits are made of there.

Derivatives are in u = t/h, and Q is as large as one: no power of a short time or of a small Q leaves the
range of doubles. With D = Q·Q, v(a, b) = Vec(ā b) and N = 2 v(Q, Q') the k-th rate is X_k/(hD)^k [HZ2019],
by Leibniz' rule in N = ω D: X_(k+1) = N^(k) D^k - Σ C(k, i) X_(i+1) D^(k-i-1) (d/du)^(k-i) D for i < k.
Derivatives of N and D are made of those of Q: differences of products would lose what is small beside them.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np

from timelaw.limits.formula import Vector, cross, dot, product
from timelaw.numerics.polynomial import Polynomial

EVEN = 2.0  # times the least control point of D is the largest at most; else powers of D drown in rounding
DEPTH = 24  # halvings; a Q that is ten million times smaller there than its control points can be told from 0

Quaternion = list[Polynomial]


@dataclass(frozen=True)
class CurveForm:
    """The part of a piece of `duration` h [s] for u from `start` to `end`, Q^(j) (4) = `derivatives`[j]."""

    duration: float
    start: float
    end: float
    derivatives: tuple[Quaternion, ...]

    def split(self, depth: int = DEPTH) -> Iterator["CurveForm"]:
        """Parts on which D is even enough, or lost in rounding at an end."""
        control = self.square.control
        lost = min(control[0], control[-1]) <= self.square.error
        if not depth or lost or np.max(control) <= EVEN * np.min(control):
            yield self
            return
        middle = (self.start + self.end) / 2
        halves = [[part.halve() for part in q] for q in self.derivatives]
        for side, (start, end) in enumerate(((self.start, middle), (middle, self.end))):
            own = tuple([part[side] for part in q] for q in halves)
            yield from CurveForm(self.duration, start, end, own).split(depth - 1)

    @property
    def square(self) -> Polynomial:
        """D, of degree 2d."""
        return self._squares[0]

    @property
    def slope(self) -> Polynomial:
        """D' in u."""
        return self._squares[1]

    def power(self, exponent: int) -> Polynomial:
        """(h D)^exponent."""
        return _raise(self._scaled_powers, exponent)

    def numerators(self, highest: int) -> dict[int, Vector]:
        """X_k (3) for k = 1 … `highest`: ω = X_1/hD, α = X_2/(hD)², jerk = X_3/(hD)³, snap = X_4/(hD)⁴."""
        known = self._numerators
        for k in range(len(known), highest):
            found = self._derive_vector(k)
            if k:
                found = [part * _raise(self._powers, k) for part in found]
            for i in range(k):
                factor = self._squares[k - i] * -float(comb(k, i))
                if k - i > 1:
                    factor = factor * _raise(self._powers, k - i - 1)
                found = [a + b * factor for a, b in zip(found, known[i + 1], strict=True)]
            known[k + 1] = found
        return {k: known[k] for k in range(1, highest + 1)}

    def turn_back(self, vector: Vector) -> Vector:
        """A vector v (3) of the world in body axes, times hD: the vector part of Q̄ ⊗ (0, hv) ⊗ Q."""
        if not any(vector):
            return vector
        inner = [Polynomial(np.zeros(1)), *(Polynomial(np.array([self.duration])) * part for part in vector)]
        q = self.derivatives[0]
        return product(product(_conjugate(q), inner), q)[1:]

    def _derive_vector(self, order: int) -> Vector:
        """The k-th derivative of N; v(a, b) = -v(b, a)."""
        total: Vector = [Polynomial(np.zeros(1))] * 3
        for i in range((order + 2) // 2):
            weight = 2.0 * (comb(order, i) - (comb(order, i - 1) if i else 0))
            parts = _turn(self.derivatives[i], self.derivatives[order + 1 - i])
            total = [a + b * weight for a, b in zip(total, parts, strict=True)]
        return total

    @cached_property
    def _squares(self) -> list[Polynomial]:
        """D and its derivatives."""
        q = self.derivatives
        found = []
        for order in range(len(q) - 1):
            terms = [_dot4(q[i], q[order - i]) * float(comb(order, i)) for i in range(order + 1)]
            found.append(sum(terms[1:], terms[0]))
        return found

    @cached_property
    def _powers(self) -> dict[int, Polynomial]:
        return {1: self.square}

    @cached_property
    def _scaled_powers(self) -> dict[int, Polynomial]:
        return {1: self.square * self.duration}

    @cached_property
    def _numerators(self) -> dict[int, Vector]:
        return {}


def _raise(known: dict[int, Polynomial], exponent: int) -> Polynomial:
    """A power of known[1], by halves."""
    if exponent not in known:
        half = exponent // 2
        known[exponent] = _raise(known, half) * _raise(known, exponent - half)
    return known[exponent]


def _turn(p: Quaternion, q: Quaternion) -> Vector:
    """v(p, q)."""
    across = cross(q[1:], p[1:])
    return [p[0] * q[i + 1] + q[0] * p[i + 1] * -1.0 + across[i] for i in range(3)]


def _dot4(p: Quaternion, q: Quaternion) -> Polynomial:
    total: Polynomial = p[0] * q[0] + dot(p[1:], q[1:])
    return total


def _conjugate(q: Quaternion) -> Quaternion:
    return [q[0], *(part * -1.0 for part in q[1:])]
