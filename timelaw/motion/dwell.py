"""Segments of kind `dwell`: the body rests at a node."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from timelaw.easing.easing import Side
from timelaw.numerics.array import Array
from timelaw.numerics.polynomial import Polynomial


@dataclass(frozen=True)
class Dwell:
    """q(t) = `orientation` (4,) for `duration` [s] from `start_time`, at the node labelled `at`."""

    kind: ClassVar[str] = "dwell"
    breaks: ClassVar[Array] = np.array([0.0, 1.0])

    at: str
    start_time: float
    duration: float
    orientation: Array

    @property
    def name(self) -> str:
        """How reports call the segment."""
        return f"dwell at {self.at}"

    @property
    def origin(self) -> str:
        """The node's label."""
        return self.at

    target = origin

    @property
    def start(self) -> Array:
        """Orientation at the first instant."""
        return self.orientation

    end = start

    @property
    def end_time(self) -> float:
        """Instant [s] at which the segment ends."""
        return self.start_time + self.duration

    def __call__(self, tau: Array, order: int, side: Side) -> Array:  # noqa: ARG002
        """The orientation (m, 4) for order 0, else zeros (m, 3)."""
        size = np.shape(tau)
        return np.broadcast_to(self.orientation, (*size, 4)).copy() if order == 0 else np.zeros((*size, 3))

    def rates(self, order: int) -> list[Polynomial]:  # noqa: ARG002
        """Nothing moves."""
        return [Polynomial(np.zeros(1))]

    def side(self, order: int, end: int) -> Array:  # noqa: ARG002
        """The k-th rate (3,) at the first (0) or last (-1) instant: zero."""
        return np.zeros(3)
