"""Find the extrema of limit rows that exceed their bounds, to demand the limits there too.

This only guides the solver; what is proved is proved by the certificate.
"""

from collections.abc import Sequence

import numpy as np

from timelaw.easing import Timing
from timelaw.limits import Demand, Row
from timelaw.nlp.program import Program
from timelaw.numerics.array import Array

SAME_POINT = 1e-7  # in τ; nearer to a point, an extremum exceeds the bound by far less than the gap
NEAR = 0.1  # relative; a grid value this close to the bound may hide an extremum beyond it
DEPARTURES = np.linspace(0.0, 1.0, 1025)  # where a leg is looked at for running beyond its arc
DEPARTED = 1e-4  # of the leg
ZOOMS = 5  # each narrows the bracket of an extremum eightfold
ZOOM_POINTS = np.linspace(-1.0, 1.0, 17)


def add_extrema(points: list[list[Array]], program: Program, timings: Sequence[Timing], used: float) -> bool:
    """Add the local extrema beyond `used` times each bound to its points; False if there is nothing new.

    The midpoints towards the points on both sides come along: where a rate stays flat at its
    limit its extrema are as flat, and would be approached only by halves.
    """
    added = False
    legs = zip(program.demands, timings, program.bases, strict=True)
    for k, (demand, timing, basis) in enumerate(legs):
        for i, row in enumerate(demand.rows):
            known = points[k][i]
            for top in _extrema(row, used**row.root, demand, timing, basis.grid()):
                place = int(np.searchsorted(known, top))
                around = known[max(place - 1, 0) : place + 1]
                if np.min(np.abs(around - top)) > SAME_POINT:
                    points[k][i] = np.union1d(points[k][i], [top, *(around + top) / 2])
                    added = True
    return added


def add_departures(stay: list[Array], program: Program, timings: Sequence[Timing]) -> bool:
    """Add where a leg runs beyond its arc, or half a turn beyond that where it may; False if none does."""
    added = False
    for k, (demand, timing, strays) in enumerate(
        zip(program.demands, timings, program.straying, strict=True)
    ):
        if not strays:
            continue
        beyond = program.beyond / demand.angle
        away = np.abs(timing.easing(DEPARTURES) - 0.5) - 0.5 - beyond
        padded = np.concatenate([[-1.0], away, [-1.0]])
        tops = (away >= padded[:-2]) & (away >= padded[2:]) & (away > DEPARTED * (1 + beyond))
        new = np.setdiff1d(DEPARTURES[tops], stay[k])
        if len(new):
            stay[k], added = np.union1d(stay[k], new), True
    return added


def _extrema(row: Row, allowed: float, demand: Demand, timing: Timing, grid: Array) -> list[float]:
    """Points τ of the local maxima of a row that exceed the allowed part of its bound."""

    def size(tau: Array) -> Array:
        rates = {k: demand.angle / timing.duration**k * timing.easing(tau, k) for k in row.orders}
        return np.array(np.abs(row.value(rates)) / (row.bound * allowed))

    values = size(grid)
    padded = np.concatenate([[-1.0], values, [-1.0]])
    tops = np.flatnonzero((values >= padded[:-2]) & (values >= padded[2:]) & (values > 1 - NEAR))
    if not len(tops):
        return []
    centre, last = grid[tops], len(grid) - 1
    width = np.maximum(grid[np.minimum(tops + 1, last)] - centre, centre - grid[np.maximum(tops - 1, 0)])
    for _ in range(ZOOMS):
        around = np.clip(centre[:, None] + width[:, None] * ZOOM_POINTS, 0.0, 1.0)
        best = np.argmax(size(around), axis=1)
        centre, width = around[np.arange(len(centre)), best], width * (ZOOM_POINTS[1] - ZOOM_POINTS[0])
    return [float(t) for t, value in zip(centre, size(centre), strict=True) if value > 1]
