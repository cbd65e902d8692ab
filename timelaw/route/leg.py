"""A leg: the great-circle arc from one orientation to the next, the shorter way round on SO(3)."""

from dataclasses import dataclass

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import from_axis_angle, multiply


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

    def orientation(self, s: Array) -> Array:
        """Unit quaternions (..., 4) at the fractions s (...) of the leg."""
        return multiply(self.start, from_axis_angle(self.axis, self.angle * np.asarray(s, dtype=float)))
