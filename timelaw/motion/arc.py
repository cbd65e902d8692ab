"""Segments of kind `arc`: a great-circle arc run through by an easing."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from timelaw.easing import Easing, Timing
from timelaw.easing.easing import Side
from timelaw.limits import Bounds
from timelaw.numerics.array import Array
from timelaw.numerics.polynomial import Polynomial
from timelaw.numerics.quaternion import from_axis_angle, multiply


@dataclass(frozen=True)
class Arc:
    """q = q_i ⊗ (cos(fθ/2), n sin(fθ/2)), f = easing((t - start_time)/duration).

    `start`, `end` (4,) and the unit `axis` n (3,), in body axes, are kept as they were given:
    whether they agree with `angle` θ [rad] is for the certificate to say. `limits` hold on this
    segment besides those of the law.
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
    limits: Mapping[str, Bounds] = field(default_factory=dict)

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

    @property
    def breaks(self) -> Array:
        """Breaks of the easing (p+1,) ⊂ [0, 1]."""
        return self.easing.breaks

    def rates(self, order: int) -> list[Polynomial]:
        """The k-th time derivative of the travelled angle, a polynomial on each interval."""
        return self.timing.rates(self.angle, order)

    def side(self, order: int, end: int) -> Array:
        """The k-th rate (3,) at the first (0) or last (-1) instant, from inside."""
        return np.array(self.rates(order)[end].control[end] * self.axis)
