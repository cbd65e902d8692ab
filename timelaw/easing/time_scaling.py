"""Bring timings to their limits: peaks proved on the polynomials, time stretched by the exact factor."""

from collections.abc import Sequence
from functools import partial
from math import inf

from timelaw.easing.timing import Timing
from timelaw.errors import InfeasibleError
from timelaw.limits import Demand, Row
from timelaw.limits.polynomials import expand_rows
from timelaw.numerics.function import enclose_peaks

CLEARANCE = 1e-12  # relative: covers the rounding of the stretched durations themselves
REPETITIONS = 8
ROOT_TOLERANCE = 1e-14  # relative, of a factor found as a root; the clearance covers it


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
    """Stretch (or shrink) all legs of a run by one factor, so that the worst limit is just held, proved.

    One factor keeps rates equal from both sides at the nodes of the run.

    Raises:
        InfeasibleError: the law does not come within its limits, as where its numbers are not finite.
    """
    return hold_limits(demands, scale_to_limits(demands, timings))


def scale_to_limits(demands: Sequence[Demand], timings: Sequence[Timing]) -> tuple[Timing, ...]:
    """The same, without the proof that what came out holds the limits: it does but for rounding.

    Raises:
        InfeasibleError: no factor does.
    """
    factor = _find_factor(demands, timings)
    if not 0 < factor < inf:
        raise _say_how_far(demands, timings)
    return _stretch(timings, factor * (1 + CLEARANCE))


def hold_limits(demands: Sequence[Demand], timings: Sequence[Timing]) -> tuple[Timing, ...]:
    """Timings that hold their limits but for rounding, stretched further until it is proved that they do.

    A few repetitions with a growing clearance absorb the rounding.

    Raises:
        InfeasibleError: they do not come within their limits.
    """
    held, clearance = tuple(timings), CLEARANCE
    for _ in range(REPETITIONS):
        if used_fraction(demands, held) <= 1:
            return held
        clearance *= 10
        held = _stretch(held, _find_factor(demands, held) * (1 + clearance))
    raise _say_how_far(demands, held)


def _say_how_far(demands: Sequence[Demand], timings: Sequence[Timing]) -> InfeasibleError:
    used = used_fraction(demands, timings)
    return InfeasibleError(
        f"no stretch of time brings the law within its limits: {used:.9g} of them is used at the end"
    )


def _stretch(timings: Sequence[Timing], factor: float) -> tuple[Timing, ...]:
    return tuple(timing.stretched(factor) for timing in timings)


def _find_factor(demands: Sequence[Demand], timings: Sequence[Timing]) -> float:
    """The factor by which time is stretched until the worst limit is just held.

    Where every row is homogeneous, g falls as time^power and the factor is exact. A row whose terms fall by
    different powers gives a bracket, and the factor is the root of used part = 1 in it.
    """
    used = list_used(demands, timings)
    factors: list[list[float]] = [[ratio ** (1 / power) for power in row.powers] for row, ratio in used]
    least, most = max(min(f) for f in factors), max(max(f) for f in factors)
    if least == most or not most < inf:
        return most
    from scipy.optimize import brentq

    def excess(factor: float) -> float:
        return max(float(ratio) for _, ratio in list_used(demands, _stretch(timings, factor))) - 1

    if excess(least) <= 0:
        return least
    return float(brentq(excess, least, most * (1 + CLEARANCE), rtol=ROOT_TOLERANCE))
