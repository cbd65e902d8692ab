"""Bring timings to their limits: peaks proved on the polynomials, time stretched by the exact factor."""

from collections.abc import Sequence
from functools import partial
from itertools import compress
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
    return _list_used_by_run([demands], [timings])[0]


def used_fraction(demands: Sequence[Demand], timings: Sequence[Timing]) -> float:
    """The largest part of any limit that is used, proved: above 1, a limit is broken."""
    return _find_fraction(list_used(demands, timings))


def fit_to_limits(demands: Sequence[Demand], timings: Sequence[Timing]) -> tuple[Timing, ...]:
    """Stretch (or shrink) all legs of a run by one factor, so that the worst limit is just held.

    One factor keeps rates equal from both sides at the nodes of the run. A few repetitions with a growing
    clearance absorb the rounding of the factor.

    Raises:
        InfeasibleError: the law does not come within its limits, as where its numbers are not finite.
    """
    return fit_runs([demands], [timings])[0]


def fit_runs(runs: Sequence[Sequence[Demand]], laws: Sequence[Sequence[Timing]]) -> list[tuple[Timing, ...]]:
    """Runs that are independent of each other, each by its own factor; all peaks are proved at once.

    Raises:
        InfeasibleError: a law does not come within its limits, as where its numbers are not finite.
    """
    fitted, clearance = [tuple(timings) for timings in laws], CLEARANCE
    open_, used = list(range(len(runs))), _list_used_by_run(runs, laws)
    for _ in range(REPETITIONS):
        for i, rows in zip(open_, used, strict=True):
            fitted[i] = _stretch(fitted[i], _find_factor(runs[i], fitted[i], rows) * (1 + clearance))
        used = _list_used_by_run([runs[i] for i in open_], [fitted[i] for i in open_])
        over = [not _find_fraction(rows) <= 1 for rows in used]  # or no number
        open_, used = list(compress(open_, over)), list(compress(used, over))
        if not open_:
            return fitted
        clearance *= 10
    message = "no stretch of time brings the law within its limits: {:.9g} of them is used at the end"
    raise InfeasibleError(message.format(_find_fraction(used[0])))


def _list_used_by_run(
    runs: Sequence[Sequence[Demand]], laws: Sequence[Sequence[Timing]]
) -> list[list[tuple[Row, float]]]:
    """Of each run every row of every leg with its proved peak over its bound."""
    found = [
        (run, row, polynomial)
        for run, (demands, timings) in enumerate(zip(runs, laws, strict=True))
        for demand, timing in zip(demands, timings, strict=True)
        for row, _, polynomial in expand_rows(demand.rows, partial(timing.rates, demand.angle))
    ]
    tops = enclose_peaks([polynomial for *_, polynomial in found])
    used: list[list[tuple[Row, float]]] = [[] for _ in runs]
    for (run, row, _), top in zip(found, tops, strict=True):
        used[run].append((row, top.upper / row.bound))
    return used


def _find_fraction(used: Sequence[tuple[Row, float]]) -> float:
    return max(float(ratio ** (1 / row.root)) for row, ratio in used)


def _stretch(timings: Sequence[Timing], factor: float) -> tuple[Timing, ...]:
    return tuple(timing.stretched(factor) for timing in timings)


def _find_factor(
    demands: Sequence[Demand], timings: Sequence[Timing], used: Sequence[tuple[Row, float]]
) -> float:
    """The factor by which time is stretched until the worst limit is just held.

    Where every row is homogeneous, g falls as time^power and the factor is exact. A row whose terms fall by
    different powers gives a bracket, and the factor is the root of used part = 1 in it.
    """
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
