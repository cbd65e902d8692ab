"""A curve through orientations as the states of its knots: what is chosen, its control points, their slopes.

Each leg is run through in `pieces` of one duration. A knot has a quaternion q, ω and α in body axes; of
constant norm to second order there, Q = q, Q' = q ⊗ (0, ω/2), Q'' = q ⊗ (-|ω|²/4, α/2), so that over h, of
degree d, b_1 = q ⊗ (1, hω/2d), b_2 = q ⊗ (1 - h²|ω|²/4d(d-1), hω/d + h²α/2d(d-1)), mirrored at the other
end: class C² and the nodes are exact whatever is chosen. Between stand b_i = m ⊗ (1 + ρ, c_i), m the
normalised sum of the piece's ends, with one weight ρ for each piece.
"""

from dataclasses import dataclass, replace

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import elevate
from timelaw.numerics.quaternion import conjugate, multiply, normalise

LEAST_DEGREE = 5
OMEGA, ALPHA, TURN = slice(0, 3), slice(3, 6), slice(6, 9)  # of a knot's columns
KNOT = 9  # columns of a knot; those of a piece are two knots', its duration, its weight, its inner points


@dataclass(frozen=True)
class Curve:
    """K legs of p pieces: Kp+1 knots with `turn` q (·, 4), `omega`, `alpha` (·, 3).

    `duration` h (K,) is that of a leg's pieces; `middle` m (Kp, 4), `weight` ρ (Kp,) and `inner` c
    (Kp, d-5, 3) are of the pieces.
    """

    degree: int
    pieces: int
    turn: Array
    omega: Array
    alpha: Array
    duration: Array
    middle: Array
    weight: Array
    inner: Array

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
        omega, alpha = self.omega / factor, self.alpha / factor**2
        return replace(self, duration=self.duration * factor, omega=omega, alpha=alpha)

    def control(self) -> Array:
        """Control points (Kp, d+1, 4)."""
        points = np.empty((len(self.weight), self.degree + 1, 4))
        for end in (0, -1):
            for place, point in enumerate(self._end(end)):
                points[:, place if end == 0 else -1 - place] = point
        if self.inner.shape[1]:
            ones = np.broadcast_to(1 + self.weight[:, None, None], (*self.inner.shape[:2], 1))
            points[:, 3:-3] = multiply(self.middle[:, None], np.concatenate([ones, self.inner], axis=-1))
        return points

    def _end(self, end: int) -> tuple[Array, Array, Array]:
        """The first three points from an end."""
        q, omega, alpha, sign = self._knots(end)
        h, d = self.steps[:, None], self.degree
        square = np.sum((h * omega) ** 2, axis=1, keepdims=True) / (4 * d * (d - 1))
        one = np.hstack([np.ones_like(h), sign * h * omega / (2 * d)])
        two = np.hstack([1 - square, sign * h * omega / d + h * h * alpha / (2 * d * (d - 1))])
        return q, multiply(q, one), multiply(q, two)

    def _knots(self, end: int) -> tuple[Array, Array, Array, float]:
        own = slice(None, -1) if end == 0 else slice(1, None)
        return self.turn[own], self.omega[own], self.alpha[own], 1.0 if end == 0 else -1.0

    def slopes(self, points: Array) -> Array:
        """∂b (Kp, d+1, 4, v) of `points` by the columns of their piece: both knots, h, ρ, c."""
        count, d = len(self.weight), self.degree
        found = np.zeros((count, d + 1, 4, 2 * KNOT + 1 + self._own))
        for end in (0, -1):
            places = [0, 1, 2] if end == 0 else [d, d - 1, d - 2]
            self._derive_end(end, 0 if end == 0 else KNOT, points[:, places], found, places)
        if self._own:
            turn = left_matrix(self.middle)
            for i in range(self.inner.shape[1]):
                found[:, 3 + i, :, 2 * KNOT + 1] = turn[:, :, 0]
                first = 2 * KNOT + 2 + 3 * i
                found[:, 3 + i, :, first : first + 3] = turn[:, :, 1:]
        return found

    @property
    def _own(self) -> int:
        return 1 + 3 * self.inner.shape[1] if self.inner.shape[1] else 0

    def _derive_end(self, end: int, at: int, points: Array, found: Array, places: list[int]) -> None:
        """Fill in the slopes of the three points at an end."""
        q, omega, alpha, sign = self._knots(end)
        h, d, last = self.steps, self.degree, 2 * KNOT
        one, two = np.zeros((2, len(h), 4, found.shape[-1]))
        for i in range(3):
            one[:, i + 1, at + i] = sign * h / (2 * d)
            two[:, 0, at + i] = -(h**2) * omega[:, i] / (2 * d * (d - 1))
            two[:, i + 1, at + i] = sign * h / d
            two[:, i + 1, at + 3 + i] = h**2 / (2 * d * (d - 1))
        one[:, 1:, last] = sign * omega / (2 * d)
        two[:, 0, last] = -h * np.sum(omega**2, axis=1) / (2 * d * (d - 1))
        two[:, 1:, last] = sign * omega / d + h[:, None] * alpha / (d * (d - 1))
        turn = left_matrix(q)
        found[:, places[1]] = turn @ one
        found[:, places[2]] = turn @ two
        relative = multiply(conjugate(q)[:, None], points)
        for i, unit in enumerate(np.eye(4)[1:]):
            moved = multiply(multiply(q, unit)[:, None], relative)
            for k, place in enumerate(places):
                found[:, place, :, at + 6 + i] = moved[:, k]


def make_curve(degree: int, pieces: int, turn: Array, omega: Array, alpha: Array, duration: Array) -> Curve:
    """The quintics between the states of knots, raised to a degree with one weight for each piece."""
    middle = normalise(turn[1:] + turn[:-1])
    blank = np.zeros((len(middle), 0, 3))
    plain = Curve(LEAST_DEGREE, pieces, turn, omega, alpha, duration, middle, np.zeros(len(middle)), blank)
    if degree == LEAST_DEGREE:
        return plain
    raised = np.moveaxis(elevate(np.moveaxis(plain.control(), 1, -1), degree), -1, 1)
    seen = multiply(conjugate(middle)[:, None], raised[:, 3:-3])
    return replace(plain, degree=degree, weight=np.mean(seen[..., 0], axis=1) - 1, inner=seen[..., 1:])


def left_matrix(q: Array) -> Array:
    """The matrices (n, 4, 4) of q ⊗ ·."""
    return np.stack([multiply(q, unit) for unit in np.eye(4)], axis=-1)
