"""The motion of the body as a function of time: orientation, matrices, and rates in body axes."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from timelaw.easing.easing import Side
from timelaw.motion.arc import Arc
from timelaw.numerics.bernstein import integral_of_square
from timelaw.numerics.quaternion import rotation_matrix
from timelaw.route import Route
from timelaw.time_law import TimeLaw
from timelaw.time_law.time_law import locate

Array = NDArray[np.float64]


@dataclass(frozen=True)
class QuaternionLaw:
    """Segments that follow each other from t = 0; `limits` are the bounds the law is made for, in SI."""

    name: str
    segments: tuple[Arc, ...]
    limits: Mapping[str, float]

    @property
    def times(self) -> Array:
        """Start times of the segments and the end of the last (n+1,) [s]."""
        return np.array([s.start_time for s in self.segments] + [self.segments[-1].end_time])

    @property
    def duration(self) -> float:
        """Total time [s]."""
        return self.segments[-1].end_time

    @property
    def labels(self) -> tuple[str, ...]:
        """Labels of the nodes (n+1)."""
        return (self.segments[0].origin, *(s.target for s in self.segments))

    def __call__(self, t: ArrayLike, order: int = 0, side: Side = "right") -> Array:
        """Unit quaternions q (..., 4) for order 0; ω, α, jerk (..., 3) in body axes for 1, 2, 3.

        At a node, or a break inside a segment, the value from the given side.

        Raises:
            ValueError: t (...) outside [0, duration], or an order other than 0 to 3.
        """
        if order not in (0, 1, 2, 3):
            raise ValueError(f"order {order}; 0 (q), 1 (ω), 2 (α) or 3 (jerk) is needed")
        t = np.asarray(t, dtype=float)
        index = locate(self.times, t, side)
        value = np.empty((*t.shape, 4 if order == 0 else 3))
        for k in np.unique(index):
            here = index == k
            segment = self.segments[k]
            tau = np.clip((t[here] - segment.start_time) / segment.duration, 0.0, 1.0)
            value[here] = segment(tau, order, side)
        return value

    def rotation(self, t: ArrayLike) -> Array:
        """R(t) (..., 3, 3): r_world = R r_body [MMB2017]."""
        return rotation_matrix(self(t))

    def direction_cosines(self, t: ArrayLike) -> Array:
        """Q(t) = R(t)ᵀ (..., 3, 3): its rows are the body axes in world coordinates [MMB2017]."""
        return np.swapaxes(self.rotation(t), -1, -2)

    def effort(self, order: int) -> float:
        """∫ |k-th rate|² dt over the motion, exact: k = 3 is the smoothness ∫|jerk|² dt [rad²/s⁵]."""
        return sum(
            integral_of_square(control) * float(width) * segment.duration
            for segment in self.segments
            for (control, _), width in zip(segment.rates(order), np.diff(segment.easing.breaks), strict=True)
        )


def compose(name: str, route: Route, time_law: TimeLaw, limits: Mapping[str, float]) -> QuaternionLaw:
    """Lay a time law along its route."""
    times = time_law.times
    segments = [
        Arc(
            leg.origin,
            leg.target,
            float(start),
            timing.duration,
            leg.start,
            leg.end,
            leg.axis,
            leg.angle,
            timing.easing,
        )
        for leg, timing, start in zip(route.legs, time_law.timings, times[:-1], strict=True)
    ]
    return QuaternionLaw(name, tuple(segments), dict(limits))
