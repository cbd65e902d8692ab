"""Where limits are demanded first, and how much of each: not quite all where time cannot be stretched.

A motion that begins or ends moving at a limit has no room for a margin there: it grows from nothing at that
end, as τ², which a motion leaves room for whose acceleration is continuous.
"""

from collections.abc import Sequence
from itertools import accumulate

import numpy as np

from timelaw.limits import Row
from timelaw.nlp.program import Program
from timelaw.nlp.transcription import Points
from timelaw.numerics.array import Array
from timelaw.requirements.end_rates import is_at_limit

NEAR = 1e-4  # of a limit: as near to it at an end, the margin grows from nothing
GROWN = 0.1  # of the leg: where the margin is whole


def list_points(program: Program) -> Points:
    """Points τ of each row of each leg; not the ends of the motion where its rates are at a limit."""
    found: Points = []
    for demand, basis, ends in zip(program.demands, program.bases, _list_ends(program), strict=True):
        rows = []
        for row in demand.rows:
            tau = basis.points(row.orders)
            for place, rates in zip((0.0, 1.0), ends, strict=True):
                tau = tau[tau != place] if is_at_limit(row, rates, NEAR) else tau
            rows.append(tau)
        found.append(rows)
    return found


def list_stays(program: Program) -> list[Array]:
    """Points τ of each leg where the body must be on its arc; none where it stays there by itself."""
    legs = zip(program.bases, program.straying, strict=True)
    return [basis.points([1])[1:-1] if strays else np.zeros(0) for basis, strays in legs]


def list_rooms(program: Program, points: Points) -> Points:
    """The part of each bound that is used at most at each point."""
    if program.elastic:
        return [[np.ones(len(tau)) for tau in rows] for rows in points]
    ends = _list_ends(program)
    return [
        [1 - program.margin * _grow(row, tau, around) for row, tau in zip(demand.rows, rows, strict=True)]
        for demand, rows, around in zip(program.demands, points, ends, strict=True)
    ]


def _grow(row: Row, tau: Array, ends: tuple[Sequence[float], Sequence[float]]) -> Array:
    share = np.ones(len(tau))
    for distance, rates in zip((tau, 1 - tau), ends, strict=True):
        if is_at_limit(row, rates, NEAR):
            share = np.minimum(share, (distance / GROWN) ** 2)
    return share


def _list_ends(program: Program) -> list[tuple[Sequence[float], Sequence[float]]]:
    """The rates from outside the motion at the start and at the end of each leg; none inside a run."""
    ends: list[tuple[Sequence[float], Sequence[float]]] = [((), ())] * len(program.demands)
    boundaries = [0, *accumulate(len(run.demands) for run in program.runs)]
    for run, first, after in zip(program.runs, boundaries, boundaries[1:], strict=False):
        ends[first] = (run.start, ends[first][1])
        ends[after - 1] = (ends[after - 1][0], run.end)
    return ends
