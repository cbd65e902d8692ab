"""Breaks of splines: those of the double-S profile's phases, and how the intervals between are divided."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from timelaw.numerics.array import Array


def merge_breaks(breaks: Sequence[float], least: float) -> list[float]:
    """The breaks, from 0 to 1, without those nearer than `least` to the one before, or to the end."""
    kept = [0.0]
    for point in breaks[1:-1]:
        if point - kept[-1] >= least and 1.0 - point >= least:
            kept.append(point)
    return [*kept, 1.0]


def divide_breaks(breaks: Sequence[float], intervals: int, least: float) -> tuple[float, ...]:
    """Divide the intervals between breaks until there are about `intervals`, none shorter than `least`.

    All are divided alike, so that a short ramp gets as many as a long cruise, but for those that
    are too short for it; what these leave goes to the others. Divisions crowd at the breaks, where
    the jerk has to turn from one limit to another.
    """
    widths = np.diff(breaks)
    most = np.maximum(np.floor(widths / least), 1).astype(int)
    parts = np.ones(len(widths), dtype=int)
    while parts.sum() < intervals and np.any(parts < most):
        free = np.flatnonzero(parts < most)
        parts[free[np.lexsort((-widths[free] / parts[free], parts[free]))[0]]] += 1
    pieces = [
        a + (b - a) * _crowded(n, least / (b - a))[:-1]
        for (a, b), n in zip(pairwise(breaks), parts, strict=True)
    ]
    return (*np.concatenate(pieces).tolist(), 1.0)


def _crowded(count: int, least: float) -> Array:
    """Points (count+1,) from 0 to 1, crowding at the ends as Chebyshev's do, as far as `least` allows."""
    even = np.arange(count + 1) / count
    crowded = (1 - np.cos(np.pi * even)) / 2
    first = crowded[1]
    room = even[1] - first
    share = 1.0 if first >= least or not room else max((even[1] - least) / room, 0.0)
    return np.array(share * crowded + (1 - share) * even)
