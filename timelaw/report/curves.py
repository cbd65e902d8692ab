"""Rates over time as polylines that keep both sides of every jump."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from timelaw.motion import Arc
from timelaw.numerics.bernstein import evaluate

Array = NDArray[np.float64]

POINTS_PER_DEGREE = 16


def rate_curve(segments: Sequence[Arc], order: int) -> tuple[Array, Array]:
    """Times [s] and |k-th rate| [rad/s^k] along the segments, a few points per degree of each interval."""
    times: list[Array] = []
    values: list[Array] = []
    for segment in segments:
        breaks = segment.start_time + segment.duration * segment.easing.breaks
        for (control, _), start, end in zip(segment.rates(order), breaks, breaks[1:], strict=False):
            u = np.linspace(0.0, 1.0, 2 + POINTS_PER_DEGREE * (len(control) - 1))
            times.append(start + u * (end - start))
            values.append(np.abs(evaluate(control, u)))
    return np.concatenate(times), np.concatenate(values)
