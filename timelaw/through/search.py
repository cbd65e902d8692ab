"""Sequential cone programming: faster step by step, at any moment with a curve that holds the limits."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from timelaw.interrupts import check_interrupted
from timelaw.numerics.array import Array
from timelaw.through.columns import Columns
from timelaw.through.cone_step import Aim, solve_step
from timelaw.through.curve import Curve
from timelaw.through.measures import SAMPLES, Mask, Measure, Use, find_use, sample_used
from timelaw.through.rows import collect_rows

MOST_STEPS = 100
FIRST_RADIUS, LARGEST_RADIUS, LEAST_RADIUS = 0.3, 1.0, 1e-6  # of the trust region, in what counts as one
GOOD, POOR = 0.7, 0.25  # of the fall that was predicted: the region grows, or shrinks
MOST_OVER = 1.3  # a step may break limits by so much, to be mended by the next
FALLEN, PREDICTED = 2e-5, 8e-5  # of the time: twice less, and the search is over
CALM = 2  # so many small steps in a row end the search
FINE = 241  # samples for the last stretch
PRICE = 2.0  # of breaking what slowness does not mend, in mean durations of a leg


@dataclass(frozen=True)
class Found:
    """A curve that holds the limits on a grid, if there is one, the last one tried, and how it was found."""

    curve: Curve | None
    last: Curve
    steps: int
    rows: int


def improve(
    curve: Curve,
    columns: Columns,
    angles: Array,
    measures: Sequence[Measure],
    *,
    radius: float = FIRST_RADIUS,
    samples: int = SAMPLES,
    is_over: Callable[[], bool] = lambda: False,
) -> Found:
    """The fastest curve found, never slower than the one it begins with if that holds the limits.

    What is made less is Σ h s, s ≥ 1 the factor by which a leg by itself would have to be slower, and
    a price for what slowness does not mend.
    """
    calm, most = 0, 0
    use = find_use(curve, measures, samples)
    best = None if use.excess else curve
    merit = _merit(curve, use)
    steps = 0
    while steps < MOST_STEPS:
        steps += 1
        check_interrupted()
        best = _keep(best, curve, use)
        rows = collect_rows(curve, columns, measures, sample_used(curve, measures, samples), radius)
        most = max(most, len(rows.power))
        step = solve_step(
            curve, columns, rows, columns.scales(curve, angles), radius, _aim(curve, columns, rows.power == 0)
        )
        if step is None:  # too far beyond the limits for so small a step
            curve = curve.stretched(use.worst)
            use = find_use(curve, measures, samples)
            merit, radius = _merit(curve, use), 2 * radius
            if radius > 4 * LARGEST_RADIUS:
                break
            continue
        tried = columns.move(curve, step)
        own = find_use(tried, measures, samples)
        fall = (merit - _merit(tried, own)) / merit
        hoped = (merit - tried.total) / merit
        if fall > 0 and own.worst < MOST_OVER:
            curve, use, merit = tried, own, _merit(tried, own)
            radius = _resize(radius, fall / max(hoped, 1e-300))
            calm = calm + 1 if fall < FALLEN and hoped < PREDICTED else 0
            if calm == CALM:
                break
        elif hoped < FALLEN or radius < LEAST_RADIUS or is_over():
            break
        else:
            radius /= 3
        if is_over():
            break
    best = _keep(best, curve, use)
    if best is not None:
        best = best.stretched(find_use(best, measures, FINE).worst)
    return Found(best, curve, steps, most)


def _aim(curve: Curve, columns: Columns, soft: Mask) -> Aim:
    """Least time."""
    cost = np.zeros(columns.count)
    cost[columns.legs] = 1 / np.mean(curve.duration)
    if not np.any(soft):
        return Aim(cost)
    return Aim(cost, soft=soft, price=PRICE)


def _merit(curve: Curve, use: Use) -> float:
    time = np.sum(curve.duration * np.maximum(use.stretch, 1.0))
    broken = PRICE * np.mean(curve.duration) * np.sum(np.maximum(use.fixed - 1, 0.0))
    return float(time + broken) * curve.pieces


def _keep(best: Curve | None, curve: Curve, use: Use) -> Curve | None:
    """The faster of two once they hold the limits; what is kept does."""
    if use.excess or (best is not None and curve.total * use.worst >= best.total):
        return best
    return curve.stretched(use.worst)


def _resize(radius: float, ratio: float) -> float:
    if ratio > GOOD:
        return min(2 * radius, LARGEST_RADIUS)
    return radius / 2 if ratio < POOR else radius
