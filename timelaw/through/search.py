"""Sequential cone programming: faster step by step, at any moment with a curve that holds the limits."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.interrupts import check_interrupted
from timelaw.numerics.array import Array
from timelaw.through.columns import number_columns
from timelaw.through.cone_step import collect_rows, solve_step
from timelaw.through.curve import Curve
from timelaw.through.rate_limits import RateLimits, find_stretch, sample_used

MOST_STEPS = 100
FIRST_RADIUS, LARGEST_RADIUS, LEAST_RADIUS = 0.3, 1.0, 1e-6  # of the trust region, in what counts as one
GOOD, POOR = 0.7, 0.25  # of the fall that was predicted: the region grows, or shrinks
MOST_OVER = 1.3  # a step may break limits by so much, to be mended by the next
FALLEN, PREDICTED = 2e-5, 8e-5  # of the time: twice less, and the search is over
FINE = 241  # samples for the last stretch


@dataclass(frozen=True)
class Found:
    """A curve that holds the limits on a grid, and how it was found."""

    curve: Curve
    steps: int
    rows: int


def improve(
    curve: Curve,
    rests: NDArray[np.bool_],
    angles: Array,
    limits: RateLimits,
    *,
    radius: float = FIRST_RADIUS,
    is_over: Callable[[], bool] = lambda: False,
) -> Found:
    """The fastest curve found from one that holds the limits; never slower than that.

    What is made less is Σ h s, s ≥ 1 the factor by which a leg by itself would have to be slower.
    """
    columns = number_columns(curve, rests)
    best, calm, rows_used = curve, 0, 0
    stretch = find_stretch(curve, limits)
    merit = _merit(curve, stretch)
    steps = 0
    while steps < MOST_STEPS:
        steps += 1
        check_interrupted()
        best = _keep(best, curve, stretch)
        rows = collect_rows(curve, columns, limits, sample_used(curve, limits), radius)
        rows_used = max(rows_used, len(rows.order))
        step = solve_step(curve, columns, rows, columns.scales(curve, angles), radius)
        if step is None:  # too far beyond the limits for so small a step
            curve = curve.stretched(float(np.max(stretch)))
            stretch = find_stretch(curve, limits)
            merit, radius = _merit(curve, stretch), 2 * radius
            if radius > 4 * LARGEST_RADIUS:
                break
            continue
        tried = columns.move(curve, step)
        own = find_stretch(tried, limits)
        fall = (merit - _merit(tried, own)) / merit
        hoped = (merit - tried.total) / merit
        if fall > 0 and np.max(own) < MOST_OVER:
            curve, stretch, merit = tried, own, _merit(tried, own)
            radius = _resize(radius, fall / max(hoped, 1e-300))
            calm = calm + 1 if fall < FALLEN and hoped < PREDICTED else 0
            if calm == 2:
                break
        elif hoped < FALLEN or radius < LEAST_RADIUS or is_over():
            break
        else:
            radius /= 3
        if is_over():
            break
    best = _keep(best, curve, stretch)
    return Found(best.stretched(float(np.max(find_stretch(best, limits, FINE)))), steps, rows_used)


def _merit(curve: Curve, stretch: Array) -> float:
    return float(np.sum(curve.duration * np.maximum(stretch, 1.0))) * curve.pieces


def _keep(best: Curve, curve: Curve, stretch: Array) -> Curve:
    """The faster of two once they hold the limits; what is kept does."""
    factor = float(np.max(stretch))
    return curve.stretched(factor) if curve.total * factor < best.total else best


def _resize(radius: float, ratio: float) -> float:
    if ratio > GOOD:
        return min(2 * radius, LARGEST_RADIUS)
    return radius / 2 if ratio < POOR else radius
