"""A curve through orientations as the states of its knots: what is chosen, its control points, their slopes.

Each leg is run through in `pieces` of one duration h. A knot has a quaternion q and rates in body axes: ω,
α, and for class C³ the jerk j. Of constant norm to that order there,

    Q = q,  Q' = q ⊗ (0, ω/2),  Q'' = q ⊗ (-|ω|²/4, α/2),  Q''' = q ⊗ (-¾ ω·α, j/2 - |ω|²ω/8 + ω×α/4),

from which the first control points follow, b_i = Σ_k C(i, k) (d-k)!/d! h^k Q^(k), mirrored at the other end:
the class and the nodes are exact whatever is chosen. Between stand b_i = m ⊗ (1 + ρ, c_i), m the normalised
sum of the piece's ends, with one weight ρ for each piece.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import comb, perm
from typing import Any

import numpy as np

from timelaw.limits.formula import Vector, add, cross, dot, product
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import elevate
from timelaw.numerics.quaternion import conjugate, multiply, normalise
from timelaw.through.dual import seed, stack, stack_slopes


@dataclass(frozen=True)
class Curve:
    """K legs of p pieces: Kp+1 knots with `turn` q (·, 4) and `rates` (·, r, 3).

    `duration` h (K,) is that of a leg's pieces; `middle` m (Kp, 4), `weight` ρ (Kp,) and `inner` c
    (Kp, d-1-2r, 3) are of the pieces.
    """

    degree: int
    pieces: int
    turn: Array
    rates: Array
    duration: Array
    middle: Array
    weight: Array
    inner: Array

    @property
    def smooth(self) -> int:
        """The r of its class C^r."""
        return int(self.rates.shape[1])

    @property
    def steps(self) -> Array:
        """The durations of all pieces (Kp,)."""
        return np.repeat(self.duration, self.pieces)

    @property
    def total(self) -> float:
        """Σ p h [s]."""
        return float(np.sum(self.duration)) * self.pieces

    def stretched(self, factor: float) -> "Curve":
        """The same path in `factor` times the time."""
        powers = factor ** np.arange(1, self.smooth + 1)[:, None]
        return replace(self, duration=self.duration * factor, rates=self.rates / powers)

    def control(self) -> Array:
        """Control points (Kp, d+1, 4)."""
        ends = [
            (_components(self.turn[own]), [_components(self.rates[own, k]) for k in range(self.smooth)])
            for own in (slice(None, -1), slice(1, None))
        ]
        inner = [_components(self.inner[:, i]) for i in range(self.inner.shape[1])]
        points = self._list_points(ends, self.steps, self.weight, inner)
        return np.stack([stack(list(point)) for point in points], axis=1)

    @property
    def columns(self) -> tuple[int, int]:
        """How many variables a knot has (its rates, then its turn), and how many a piece."""
        knot = 3 * (self.smooth + 1)
        return knot, 2 * knot + 1 + (1 + 3 * self.inner.shape[1] if self.inner.shape[1] else 0)

    def slopes(self) -> Array:
        """∂b (Kp, d+1, 4, v) by the variables of their piece: both knots' rates and turns, h, ρ, c."""
        knot, count = self.columns
        ends = []
        for first, own in ((0, slice(None, -1)), (knot, slice(1, None))):
            rates = [seed(self.rates[own, k], first + 3 * k, count) for k in range(self.smooth)]
            moved = seed(np.zeros((len(self.weight), 3)), first + knot - 3, count)
            ends.append((product(_components(self.turn[own]), [1.0, *moved]), rates))
        h = seed(self.steps[:, None], 2 * knot, count)[0]
        weight: Any = self.weight
        inner: list[Vector] = []
        if self.inner.shape[1]:
            weight = seed(self.weight[:, None], 2 * knot + 1, count)[0]
            inner = [seed(self.inner[:, i], 2 * knot + 2 + 3 * i, count) for i in range(self.inner.shape[1])]
        points = self._list_points(ends, h, weight, inner)
        return np.stack([stack_slopes(list(point), h) for point in points], axis=1)

    def _list_points(
        self, ends: Sequence[tuple[Vector, Sequence[Vector]]], h: Any, weight: Any, inner: Sequence[Vector]
    ) -> list[Vector]:
        """The d+1 control points, of whatever numbers."""
        first, last = (
            _start_points(
                q, [_scale(rate, (h * sign) ** (k + 1)) for k, rate in enumerate(rates)], self.degree
            )
            for (q, rates), sign in zip(ends, (1.0, -1.0), strict=True)
        )
        middle = _components(self.middle)
        return [*first, *(product(middle, [weight + 1.0, *c]) for c in inner), *reversed(last)]


def _components(vectors: Array) -> list[Array]:
    return list(np.moveaxis(vectors, -1, 0))


def _scale(vector: Vector, factor: Any) -> Vector:
    return [part * factor for part in vector]


def _start_points(q: Vector, rates: Sequence[Vector], degree: int) -> list[Vector]:
    """The first control points from the rates times h^k."""
    omega, alpha, *others = rates
    square = dot(omega, omega)
    states = [[0.0, *_scale(omega, 0.5)], [square * -0.25, *_scale(alpha, 0.5)]]
    for jerk in others:
        turned = add(_scale(cross(omega, alpha), 0.25), _scale(omega, square * -0.125))
        states.append([dot(omega, alpha) * -0.75, *add(_scale(jerk, 0.5), turned)])
    points = [q]
    for i in range(1, len(rates) + 1):
        total: list[Any] = [1.0, 0.0, 0.0, 0.0]
        for k in range(1, i + 1):
            total = add(total, _scale(states[k - 1], comb(i, k) / perm(degree, k)))
        points.append(product(q, total))
    return points


def make_curve(degree: int, pieces: int, turn: Array, rates: Array, duration: Array) -> Curve:
    """The poorest polynomials between the states of knots, raised to a degree, one weight for each piece."""
    middle = normalise(turn[1:] + turn[:-1])
    least = least_degree(rates.shape[1])
    blank = np.zeros((len(middle), 0, 3))
    plain = Curve(least, pieces, turn, rates, duration, middle, np.zeros(len(middle)), blank)
    if degree == least:
        return plain
    raised = np.moveaxis(elevate(np.moveaxis(plain.control(), 1, -1), degree), -1, 1)
    own = slice(rates.shape[1] + 1, degree - rates.shape[1])
    seen = multiply(conjugate(middle)[:, None], raised[:, own])
    return replace(plain, degree=degree, weight=np.mean(seen[..., 0], axis=1) - 1, inner=seen[..., 1:])


def least_degree(smooth: int) -> int:
    """Of a polynomial that has r rates at both ends."""
    return 2 * smooth + 1
