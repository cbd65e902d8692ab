"""Rates over time as polylines that keep both sides of every jump."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from timelaw.motion import Segment
from timelaw.numerics.array import Array

POINTS_PER_DEGREE = 16  # even, so that the middle of an interval, often a zero, is among them
MOST_POINTS = 256  # of an interval: rational rates have degrees of a hundred, but do not bend so often


def place_points(degree: int) -> Array:
    """Where in [0, 1] a rate of this degree is drawn."""
    return np.linspace(0.0, 1.0, 3 + min(POINTS_PER_DEGREE * degree, MOST_POINTS))


def trace_rate(segments: Sequence[Segment], order: int) -> tuple[Array, Array]:
    """Times [s] and |k-th rate| [rad/s^k] along the segments, a few points per degree of each interval."""
    times: list[Array] = []
    values: list[Array] = []
    for segment in segments:
        breaks = segment.start_time + segment.duration * segment.breaks
        for rate, (start, end) in zip(segment.rates(order), pairwise(breaks), strict=True):
            u = place_points(rate.degree)
            times.append(start + u * (end - start))
            values.append(np.abs(rate(u)))
    return np.concatenate(times), np.concatenate(values)
