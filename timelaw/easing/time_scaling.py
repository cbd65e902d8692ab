"""Bring timings to their limits: peaks proved on the polynomials, time stretched by the exact factor."""

from collections.abc import Sequence
from functools import partial

from timelaw.easing.timing import Timing
from timelaw.limits import Demand, Row
from timelaw.limits.polynomials import expand_rows
from timelaw.numerics.extrema import enclose_peaks

CLEARANCE = 1e-12  # relative: covers the rounding of the stretched durations themselves
REPETITIONS = 8


def list_used(demands: Sequence[Demand], timings: Sequence[Timing]) -> list[tuple[Row, float]]:
    """Every row of every leg with its proved peak over its bound."""
    found = [
        (row, polynomial)
        for demand, timing in zip(demands, timings, strict=True)
        for row, _, polynomial in expand_rows(demand.rows, partial(timing.rates, demand.angle))
    ]
    tops = enclose_peaks([polynomial for _, polynomial in found])
    return [(row, top.upper / row.bound) for (row, _), top in zip(found, tops, strict=True)]


def used_fraction(demands: Sequence[Demand], timings: Sequence[Timing]) -> float:
    """The largest part of any limit that is used, proved: above 1, a limit is broken."""
    return max(float(ratio ** (1 / row.root)) for row, ratio in list_used(demands, timings))


def fit_to_limits(demands: Sequence[Demand], timings: Sequence[Timing]) -> tuple[Timing, ...]:
    """Stretch (or shrink) all legs of a run by one factor, so that the worst limit is just held.

    One factor keeps rates equal from both sides at the nodes of the run; every row is homogeneous
    in time, so the factor is exact but for rounding, which a few repetitions with a growing
    clearance absorb.
    """
    fitted, clearance = tuple(timings), CLEARANCE
    for _ in range(REPETITIONS):
        factor = max(ratio ** (1 / row.power) for row, ratio in list_used(demands, fitted))
        fitted = tuple(timing.stretched(factor * (1 + clearance)) for timing in fitted)
        if used_fraction(demands, fitted) <= 1:
            break
        clearance *= 10
    return fitted
