"""Quaternion polynomials Q(t), not normalised: orientation Q/|Q| and its rates, as numbers and polynomials.

With D = Q·Q, v(a, b) = Vec(ā b) and N = 2 v(Q, Q'): ω = N/D. The k-th numerator X_k, by X_1 = N and
X_(k+1) = X_k' D - k X_k D', is the (k-1)-th derivative of ω times D^k [HZ2019].
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np

from timelaw.limits.formula import Vector, product
from timelaw.numerics.array import Array, freeze
from timelaw.numerics.bernstein import differentiate, evaluate
from timelaw.numerics.polynomial import Polynomial
from timelaw.numerics.quaternion import conjugate, multiply


@dataclass(frozen=True)
class QuaternionCurve:
    """One piece: Q over `duration` h [s] by its control points (d+1, 4)."""

    duration: float
    control: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "control", freeze(self.control))

    def __call__(self, u: Array, order: int) -> Array:
        """At u = t/h (m,): unit quaternions (m, 4) for order 0, else ω, α, jerk, snap (m, 3).

        The derivatives of N = ω D by Leibniz' rule, solved for the highest of ω.
        """
        q = [self._derivative(u, k) for k in range(order + 1)]
        if order == 0:
            return np.array(q[0] / np.linalg.norm(q[0], axis=-1, keepdims=True))
        square = [_sum_products(q, k) for k in range(order)]
        rates: list[Array] = []
        for k in range(order):
            rate = 2 * _derive_vector(q, k)
            for i, lower in enumerate(rates):
                rate = rate - comb(k, i) * lower * square[k - i][..., None]
            rates.append(rate / square[0][..., None])
        return rates[-1]

    def squares(self, u: Array, order: int) -> list[Array]:
        """D and its first derivatives (m,) in time at u (m,)."""
        q = [self._derivative(u, k) for k in range(order + 1)]
        return [_sum_products(q, k) for k in range(order + 1)]

    def _derivative(self, u: Array, order: int) -> Array:
        """The k-th derivative of Q (m, 4) in time."""
        points = differentiate(self.control.T, order) / self.duration**order
        return evaluate(points, np.asarray(u)[..., None])

    @cached_property
    def square(self) -> Polynomial:
        """D, of degree 2d."""
        parts = [q * q for q in self._components(0)]
        return parts[0] + parts[1] + parts[2] + parts[3]

    def power(self, exponent: int) -> Polynomial:
        """D^exponent."""
        known = self._powers
        if exponent not in known:
            half = exponent // 2
            known[exponent] = self.power(half) * self.power(exponent - half)
        return known[exponent]

    def numerators(self, highest: int) -> dict[int, Vector]:
        """X_k (3) for k = 1 … `highest`: ω = X_1/D, α = X_2/D², jerk = X_3/D³, snap = X_4/D⁴."""
        known = self._numerators
        slope = self.square.derive(self.duration)
        for k in range(len(known), highest):
            known[k + 1] = [p.derive(self.duration) * self.square + p * slope * -float(k) for p in known[k]]
        return {k: known[k] for k in range(1, highest + 1)}

    @cached_property
    def _powers(self) -> dict[int, Polynomial]:
        return {1: self.square}

    @cached_property
    def _numerators(self) -> dict[int, Vector]:
        return {1: [part * 2.0 for part in product(self._conjugate(), self._components(1))[1:]]}

    def turn_back(self, vector: Vector) -> Vector:
        """D times a vector (3) of the world in body axes: the vector part of Q̄ ⊗ (0, h) ⊗ Q."""
        if not any(vector):
            return vector
        inner = [Polynomial(np.zeros(1)), *(Polynomial(np.ones(1)) * part for part in vector)]
        return product(product(self._conjugate(), inner), self._components(0))[1:]

    def _conjugate(self) -> list[Polynomial]:
        """Q̄."""
        q = self._components(0)
        return [q[0], *(part * -1.0 for part in q[1:])]

    def _components(self, order: int) -> list[Polynomial]:
        parts = [Polynomial(column) for column in self.control.T]
        for _ in range(order):
            parts = [part.derive(self.duration) for part in parts]
        return parts


def _derive_vector(q: Sequence[Array], order: int) -> Array:
    """The k-th derivative (m, 3) of v(Q, Q')."""
    return sum(
        (comb(order, i) * multiply(conjugate(q[i]), q[order - i + 1])[..., 1:] for i in range(order + 1)),
        np.zeros(3),
    )


def _sum_products(q: Sequence[Array], order: int) -> Array:
    """The k-th derivative (m,) of Q·Q."""
    terms = (comb(order, i) * np.sum(q[i] * q[order - i], axis=-1) for i in range(order + 1))
    return np.asarray(sum(terms))
