"""Quaternion polynomials Q(t), not normalised: orientation Q/|Q| and its rates, as numbers and polynomials.

With D = Q·Q, v(a, b) = Vec(ā b) and N = 2 v(Q, Q'): ω = N/D [HZ2019].
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np

from timelaw.motion.curve_form import CurveForm
from timelaw.numerics.array import Array, freeze
from timelaw.numerics.bernstein import differentiate, evaluate
from timelaw.numerics.polynomial import Polynomial
from timelaw.numerics.quaternion import conjugate, multiply

HIGHEST = 4  # derivatives of Q: snap needs so many


@dataclass(frozen=True)
class QuaternionCurve:
    """One piece: Q over `duration` h [s] by its control points (d+1, 4)."""

    duration: float
    control: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "control", freeze(self.control))

    def __call__(self, u: Array, order: int) -> Array:
        """At u = t/h (m,): unit quaternions (m, 4) for order 0, else ω, α, jerk, snap (m, 3).

        The derivatives of N = ω D by Leibniz' rule, solved for the highest of ω; not finite where Q is zero.
        """
        with np.errstate(divide="ignore", invalid="ignore"):
            return self._evaluate(u, order)

    def _evaluate(self, u: Array, order: int) -> Array:
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

    @cached_property
    def level(self) -> Array:
        """Control points over a power of two, which turns nothing; the largest component from 1/2 to 1."""
        return np.asarray(np.ldexp(self.control, -self.exponent))

    @cached_property
    def exponent(self) -> int:
        """Of that power of two."""
        return int(np.frexp(np.max(np.abs(self.control)))[1])

    def _derivative(self, u: Array, order: int) -> Array:
        """The k-th derivative of Q (m, 4) in time."""
        points = differentiate(self.level.T, order) / self.duration**order
        return evaluate(points, np.asarray(u)[..., None])

    @cached_property
    def form(self) -> CurveForm:
        """The whole piece as polynomials."""
        parts = [Polynomial(column) for column in self.level.T]
        derivatives = [parts]
        for _ in range(HIGHEST):
            parts = [part.derive(1.0) for part in parts]
            derivatives.append(parts)
        return CurveForm(self.duration, 0.0, 1.0, tuple(derivatives))

    @cached_property
    def forms(self) -> tuple[CurveForm, ...]:
        """The piece in parts, on each of which D is even."""
        return tuple(self.form.split())


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
