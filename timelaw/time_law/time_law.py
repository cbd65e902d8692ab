"""A time law as data: how long each leg takes and how it is run through, and where the body dwells."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from timelaw.easing import Timing
from timelaw.easing.profile import Side, locate
from timelaw.numerics.array import Array

OPTIMISED_LAW = "optimised"  # what the law is called that the solver makes
STOPPING_LAW = "stopping at corners"  # beside one that passes them


class Interval(NamedTuple):
    """A leg, by its index, or a dwell at a node, by the node's."""

    kind: str
    number: int
    start: float
    duration: float


@dataclass(frozen=True)
class TimeLaw:
    """σ(t) = k + f_k((t - t_k)/T_k) on leg k: the route parameter as a function of time.

    `dwells` [s] stand at the nodes, one more than legs; none for a law that never waits.
    """

    name: str
    timings: tuple[Timing, ...]
    dwells: tuple[float, ...] = ()

    def intervals(self) -> Iterator[Interval]:
        """Legs and dwells in the order of time, dwells of no length left out."""
        time = 0.0
        dwells = self.dwells or (0.0,) * (len(self.timings) + 1)
        for index, dwell in enumerate(dwells):
            if dwell > 0:
                yield Interval("dwell", index, time, dwell)
                time += dwell
            if index < len(self.timings):
                yield Interval("leg", index, time, self.timings[index].duration)
                time += self.timings[index].duration

    @property
    def times(self) -> Array:
        """Instants at which legs and dwells begin, and the end [s]."""
        intervals = list(self.intervals())
        return np.array([i.start for i in intervals] + [intervals[-1].start + intervals[-1].duration])

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
        intervals = list(self.intervals())
        at = locate(self.times, t, side)
        value = np.zeros(t.shape)
        for k in np.unique(at):
            here, (kind, number, start, duration) = at == k, intervals[k]
            if kind == "leg":
                tau = np.clip((t[here] - start) / duration, 0.0, 1.0)
                value[here] = self.timings[number].easing(tau, order, side) / duration**order
            if order == 0:
                value[here] += number
        return value
