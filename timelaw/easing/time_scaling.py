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
    """Stretch (or shrink) all legs of a run by one factor, so that the worst limit is just held, proved.

    One factor keeps rates equal from both sides at the nodes of the run.

    Raises:
        InfeasibleError: the law does not come within its limits, as where its numbers are not finite.
    """
    return fit_runs([demands], [timings])[0]


def scale_to_limits(demands: Sequence[Demand], timings: Sequence[Timing]) -> tuple[Timing, ...]:
    """The same, without the proof that what came out holds the limits: it does but for rounding.

    Raises:
        InfeasibleError: no factor does.
    """
    return _scale(demands, timings, list_used(demands, timings))


def hold_limits(demands: Sequence[Demand], timings: Sequence[Timing]) -> tuple[Timing, ...]:
    """Timings that hold their limits but for rounding, stretched further until it is proved that they do.

    Raises:
        InfeasibleError: they do not come within their limits.
    """
    return _hold_runs([demands], [timings])[0]


def fit_runs(runs: Sequence[Sequence[Demand]], laws: Sequence[Sequence[Timing]]) -> list[tuple[Timing, ...]]:
    """Runs that are independent of each other, each by its own factor; all peaks are proved at once.

    Raises:
        InfeasibleError: a law does not come within its limits, as where its numbers are not finite.
    """
    used = _list_used_by_run(runs, laws)
    return _hold_runs(runs, [_scale(*one) for one in zip(runs, laws, used, strict=True)])


def _scale(
    demands: Sequence[Demand], timings: Sequence[Timing], used: Sequence[tuple[Row, float]]
) -> tuple[Timing, ...]:
    factor = _find_factor(demands, timings, used)
    if not 0 < factor < inf:
        raise _say_how_far(used)
    return _stretch(timings, factor * (1 + CLEARANCE))


def _hold_runs(
    runs: Sequence[Sequence[Demand]], laws: Sequence[Sequence[Timing]]
) -> list[tuple[Timing, ...]]:
    """A few repetitions with a growing clearance absorb the rounding."""
    held, clearance, open_ = [tuple(timings) for timings in laws], CLEARANCE, list(range(len(runs)))
    for _ in range(REPETITIONS):
        used = _list_used_by_run([runs[i] for i in open_], [held[i] for i in open_])
        over = [not _find_fraction(rows) <= 1 for rows in used]  # or no number
        open_, used = list(compress(open_, over)), list(compress(used, over))
        if not open_:
            return held
        clearance *= 10
        for i, rows in zip(open_, used, strict=True):
            held[i] = _stretch(held[i], _find_factor(runs[i], held[i], rows) * (1 + clearance))
    raise _say_how_far(used[0])


def _say_how_far(used: Sequence[tuple[Row, float]]) -> InfeasibleError:
    part = _find_fraction(used)
    return InfeasibleError(
        f"no stretch of time brings the law within its limits: {part:.9g} of them is used at the end"
    )


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
