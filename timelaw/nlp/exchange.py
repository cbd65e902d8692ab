"""The exchange method: demand the limits at points, solve, add the extrema that exceed them, again.

A limit is a semi-infinite row: it must hold for all τ. Points alone are broken between (on 20 of
them by up to 0.9 %), so after each solution the local extrema beyond a limit join the points.
The excess falls quadratically, and the last part is closed by stretching time exactly.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from timelaw.easing import Timing, fit_to_limits
from timelaw.limits import Rate
from timelaw.nlp.ipopt import solve
from timelaw.nlp.run_problem import RunProblem, RunSolution, Status
from timelaw.nlp.transcription import Points, pack, transcribe

Array = NDArray[np.float64]

GAP = 1e-6  # relative, in time, between the law within the limits and the program's own optimum
ROUNDS = 12
INSIDE = 1.01  # a start on the limits themselves costs an interior-point method many iterations
SAME_POINT = 1e-7  # in τ; nearer to a point, an extremum exceeds the bound by far less than GAP
NEAR = 0.1  # relative; a grid value this close to the bound may hide an extremum beyond it
ZOOMS = 5  # each narrows the bracket of an extremum eightfold
ZOOM_POINTS = np.linspace(-1.0, 1.0, 17)
GRID = 8  # points per degree on which extrema are looked for; the proof is the certificate's


def solve_from(problem: RunProblem, start: Sequence[Timing]) -> RunSolution | None:
    """Solve a run from given timings; None where the solver fails before it has any solution."""
    unit = sum(timing.duration for timing in start) / len(start)
    points: Points = [[problem.basis.points(limit.order) for limit in problem.limits] for _ in problem.angles]
    best: RunSolution | None = None
    timings, iterations = tuple(start), 0
    for rounds in range(1, ROUNDS + 1):
        transcription = transcribe(problem, points, unit)
        inside = [timing.stretched(INSIDE) for timing in timings]
        outcome = solve(transcription.program, pack(problem, inside, unit), len(problem.angles))
        iterations += outcome.iterations
        if not outcome.acceptable or not np.all(np.isfinite(outcome.x)):
            return best if best is None else replace(best, status=Status.ACCEPTABLE, iterations=iterations)
        relaxed = transcription.timings(outcome.x)
        timings = fit_to_limits(problem.angles, relaxed, problem.limits)
        bound = sum(timing.duration for timing in relaxed)
        status = Status.OPTIMAL if outcome.solved else Status.ACCEPTABLE
        found = RunSolution(timings, status, iterations, rounds, bound, len(transcription.labels))
        best = found if best is None or found.duration <= best.duration else replace(best, bound=bound)
        if best.duration <= bound * (1 + GAP) or not _add_extrema(points, problem, relaxed):
            break
    return best


def _add_extrema(points: Points, problem: RunProblem, timings: Sequence[Timing]) -> bool:
    """Add the local extrema beyond each limit to its points; False if there is nothing new.

    The midpoints towards the points on both sides come along: where a rate stays flat at its
    limit its extrema are as flat, and would be approached only by halves.
    """
    added = False
    for k, (angle, timing) in enumerate(zip(problem.angles, timings, strict=True)):
        for i, limit in enumerate(problem.limits):
            known = points[k][i]
            for top in _extrema(problem, limit, angle, timing):
                place = int(np.searchsorted(known, top))
                around = known[max(place - 1, 0) : place + 1]
                if np.min(np.abs(around - top)) > SAME_POINT:
                    points[k][i] = np.union1d(points[k][i], [top, *(around + top) / 2])
                    added = True
    return added


def _extrema(problem: RunProblem, limit: Rate, angle: float, timing: Timing) -> list[float]:
    """Points τ of the local maxima of a limit's rows that exceed the bound."""

    def sizes(tau: Array) -> list[Array]:
        rates = {k: angle / timing.duration**k * timing.easing(tau, k) for k in limit.orders}
        return [np.abs(row.value) / row.bound for row in limit.rows(rates)]

    count = GRID * problem.basis.degree + 1
    grid = (1 - np.cos(np.pi * np.arange(count) / (count - 1))) / 2  # extrema crowd at the ends
    found: list[float] = []
    for row, size in enumerate(sizes(grid)):
        padded = np.concatenate([[-1.0], size, [-1.0]])
        tops = np.flatnonzero((size >= padded[:-2]) & (size >= padded[2:]) & (size > 1 - NEAR))
        centre = grid[tops]
        width = np.maximum(
            grid[np.minimum(tops + 1, count - 1)] - centre, centre - grid[np.maximum(tops - 1, 0)]
        )
        for _ in range(ZOOMS if len(tops) else 0):
            around = np.clip(centre[:, None] + width[:, None] * ZOOM_POINTS, 0.0, 1.0)
            values = sizes(around)[row]
            best = np.argmax(values, axis=1)
            centre, width = around[np.arange(len(centre)), best], width * (ZOOM_POINTS[1] - ZOOM_POINTS[0])
        found += [float(t) for t, size_at in zip(centre, sizes(centre)[row], strict=True) if size_at > 1]
    return found
