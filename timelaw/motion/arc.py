"""Segments of kind `arc`: a great-circle arc run through by an easing."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from timelaw.easing import Easing, Timing
from timelaw.easing.easing import Side
from timelaw.numerics.quaternion import from_axis_angle, multiply

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Arc:
    """q = q_i ⊗ (cos(fθ/2), n sin(fθ/2)), f = easing((t - start_time)/duration).

    `start`, `end` (4,) and the unit `axis` n (3,), in body axes, are kept as they were given:
    whether they agree with `angle` θ [rad] is for the certificate to say.
    """

    kind: ClassVar[str] = "arc"

    origin: str
    target: str
    start_time: float
    duration: float
    start: Array
    end: Array
    axis: Array
    angle: float
    easing: Easing

    @property
    def name(self) -> str:
        """How reports call the segment."""
        return f"{self.origin}–{self.target}"

    @property
    def end_time(self) -> float:
        """Instant [s] at which the segment ends."""
        return self.start_time + self.duration

    @property
    def timing(self) -> Timing:
        """Duration and easing."""
        return Timing(self.duration, self.easing)

    def __call__(self, tau: Array, order: int, side: Side) -> Array:
        """At τ (m,): quaternions (m, 4) for order 0, else ω, α, jerk (m, 3) for 1, 2, 3."""
        f = self.easing(tau, order, side)
        if order == 0:
            return multiply(self.start, from_axis_angle(self.axis, self.angle * f))
        return np.array((self.angle / self.duration**order * f)[..., None] * self.axis)

    def rates(self, order: int) -> list[tuple[Array, float]]:
        """Control points of the k-th time derivative of the travelled angle, interval by interval.

        Each with a bound on its rounding errors; |n| counts, in case the axis is not a unit vector.
        """
        size = float(np.linalg.norm(self.axis))
        return [(c * size, e * size) for c, e in self.timing.rates(self.angle, order)]
