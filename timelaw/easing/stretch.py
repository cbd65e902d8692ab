"""Bring timings to their limits: peaks proved on the polynomials, time stretched by the exact factor."""

from collections.abc import Sequence

from timelaw.easing.easing import Timing
from timelaw.limits import Rate
from timelaw.numerics.extrema import peaks

CLEARANCE = 1e-12  # relative: covers the rounding of the stretched durations themselves


def utilisation(angles: Sequence[float], timings: Sequence[Timing], limits: Sequence[Rate]) -> list[float]:
    """For each limit, the proved peak over all legs divided by the bound."""
    worst = []
    for limit in limits:
        pieces, bounds = [], []
        for angle, timing in zip(angles, timings, strict=True):
            rates = {k: timing.rates(angle, k) for k in limit.orders}
            for index in range(len(timing.easing.pieces)):
                row = limit.rows({k: r[index][0] for k, r in rates.items()})
                error = limit.rows({k: r[index][1] for k, r in rates.items()})
                pieces += [r.value for r in row]
                bounds += [(e.value, r.bound) for r, e in zip(row, error, strict=True)]
        tops = peaks(pieces)
        worst.append(max((top.upper + e) / b for top, (e, b) in zip(tops, bounds, strict=True)))
    return worst


def fit_to_limits(
    angles: Sequence[float], timings: Sequence[Timing], limits: Sequence[Rate]
) -> tuple[Timing, ...]:
    """Stretch (or shrink) all legs of a run by one factor, so that the worst limit is just held.

    One factor keeps rates equal from both sides at the nodes of the run; limits (w, a, j) under
    time scaling c become (cw, c²a, c³j), so the factor is exact.
    """
    ratios = utilisation(angles, timings, limits)
    factor = max(limit.stretch(ratio) for limit, ratio in zip(limits, ratios, strict=True))
    return tuple(timing.stretched(factor * (1 + CLEARANCE)) for timing in timings)
