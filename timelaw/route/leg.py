"""A leg: the great-circle arc from one orientation to the next, the shorter way round on SO(3)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.quaternion import conjugate, from_axis_angle, multiply

Array = NDArray[np.float64]

HALF_TURN_TOLERANCE = 1e-9  # |q_i·q_j| below which both axes of a half-turn are equally short
AXIS_TOLERANCE = 1e-7  # rad; below it two axes are one: quaternions typed with 7 digits still go straight


@dataclass(frozen=True)
class Leg:
    """q(s) = q_i ⊗ (cos(sθ/2), n sin(sθ/2)), s ∈ [0, 1]: the body turns by `angle` about `axis`.

    `start`, `end` (4,) have signs that make the path continuous on S³; `axis` (3,) is the same
    unit vector in body axes all along. `half_turn`: θ = π, where -n would do as well.
    """

    origin: str
    target: str
    start: Array
    end: Array
    axis: Array
    angle: float
    half_turn: bool = False

    @property
    def name(self) -> str:
        """How reports call the leg."""
        return f"{self.origin}–{self.target}"

    def orientation(self, s: NDArray[np.float64]) -> Array:
        """Unit quaternions (..., 4) at the fractions s (...) of the leg."""
        return multiply(self.start, from_axis_angle(self.axis, self.angle * np.asarray(s, dtype=float)))


def relative_turn(p: Array, q: Array) -> tuple[Array, float, bool]:
    """Axis (3,), angle θ ∈ [0, π] and whether the axis' sense is free, of the turn from p to q.

    θ = 2 atan2(|v|, |w|) of p* ⊗ q = (w, v), which is exact also where arccos is not. For a
    half-turn -n and 2π - θ do as well.
    """
    d = multiply(conjugate(p), q)
    size = float(np.linalg.norm(d[1:]))
    angle = 2 * float(np.arctan2(size, abs(d[0])))
    axis = d[1:] / size if size else np.array([1.0, 0.0, 0.0])
    half_turn = abs(float(d[0])) <= HALF_TURN_TOLERANCE
    return axis * (1.0 if d[0] >= 0 else -1.0), angle, half_turn


def canonical(axis: Array) -> Array:
    """Of n and -n the one whose first non-zero component is positive."""
    return axis if axis[np.argmax(np.abs(axis) > AXIS_TOLERANCE)] > 0 else -axis


def turn_between(first: Array, second: Array) -> float:
    """Angle [rad, 0 to π] between two unit axes (3,)."""
    return float(np.arctan2(np.linalg.norm(np.cross(first, second)), float(first @ second)))
