"""A time law as data: how long each leg takes, and how it is run through."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from timelaw.easing import Timing
from timelaw.easing.easing import Side

Array = NDArray[np.float64]


@dataclass(frozen=True)
class TimeLaw:
    """σ(t) = k + f_k((t - t_k)/T_k) on leg k: the route parameter as a function of time."""

    name: str
    timings: tuple[Timing, ...]

    @property
    def times(self) -> Array:
        """Instants t_0 = 0 < t_1 < … (n+1,) at the nodes [s]."""
        return np.concatenate([[0.0], np.cumsum([timing.duration for timing in self.timings])])

    @property
    def duration(self) -> float:
        """Total time [s]."""
        return float(self.times[-1])

    def __call__(self, t: ArrayLike, order: int = 0, side: Side = "right") -> Array:
        """d^k σ/dt^k [1/s^k] at the times t (...); at a node from the given side; returns (...).

        Raises:
            ValueError: t outside [0, duration].
        """
        t = np.asarray(t, dtype=float)
        index = locate(self.times, t, side)
        value = np.empty(t.shape)
        for k in np.unique(index):
            here = index == k
            timing = self.timings[k]
            tau = np.clip((t[here] - self.times[k]) / timing.duration, 0.0, 1.0)
            value[here] = timing.easing(tau, order, side) / timing.duration**order + (k if order == 0 else 0)
        return value


def locate(times: Array, t: Array, side: Side) -> NDArray[np.int64]:
    """Index of the interval of `times` (n+1,) that holds each t, from the given side of a node.

    Raises:
        ValueError: t outside [times[0], times[-1]].
    """
    if np.any(~((t >= times[0]) & (t <= times[-1]))):
        raise ValueError(f"time outside [{times[0]:g}, {times[-1]:.17g}] s")
    return np.clip(np.searchsorted(times, t, side=side) - 1, 0, len(times) - 2)
