"""The exchange method: demand the limits at points, solve, add the extrema that exceed them, again.

A limit is a semi-infinite row: it must hold for all τ. Points alone are broken between (on 20 of
them by up to 0.9 %), so after each solution the local extrema beyond a limit join the points.
The excess falls quadratically. The last part is closed by stretching time exactly where that is
allowed; where times are given, the program keeps a small margin from the limits instead (`rooms`).
"""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

import numpy as np

from timelaw.easing import Timing
from timelaw.easing.time_scaling import hold_limits, scale_to_limits, used_fraction
from timelaw.errors import InfeasibleError
from timelaw.nlp.alike_runs import merge_alike
from timelaw.nlp.extrema_search import add_departures, add_extrema
from timelaw.nlp.ipopt import Outcome, solve
from timelaw.nlp.program import Program
from timelaw.nlp.rooms import list_points, list_rooms, list_stays
from timelaw.nlp.solution import GAP, Solution, Status, sum_durations
from timelaw.nlp.transcription import transcribe
from timelaw.nlp.variables import Variables
from timelaw.nlp.verdicts import Verdict
from timelaw.numerics.array import Array
from timelaw.time_limit import is_late

STATUSES = {Verdict.SOLVED: Status.OPTIMAL, Verdict.STOPPED: Status.STOPPED}
FALLEN = 1e-2  # of an effort: by so much less than its start's it is measured anew
RESCALED = 6  # times
COARSE = 1e-3  # relative: near enough for the factor of a large program that has no solution
ROUNDS = 12
INSIDE = 1.01  # a start on the limits themselves costs an interior-point method many iterations


def solve_from(
    program: Program,
    start: Sequence[Timing],
    failures: list[Verdict] | None = None,
    enough: float = inf,
    most_rounds: int | None = None,
) -> Solution | None:
    """Solve a program from given timings; None where the solver fails before it has any solution.

    A law that no stretch of time brings within the limits counts as a failure of the solver. Alike runs
    are solved as one. Verdicts of a solver that failed are added to `failures`. Where the time is over, the
    solution is what there was by then, if that is anything. As soon as the limits at the points alone take
    more time than `enough` [s], or where that is made least more than `enough` of the limits, what is known
    is returned: no point that is added makes a law faster, or gentler.
    """
    if is_late():
        return None
    alike = merge_alike(program)
    kept = [] if failures is None else failures
    solution = _prove(alike.program, _exchange(alike.program, alike.pick(start), kept, enough, most_rounds))
    if solution is not None:
        solution = _rescale(alike.program, alike.pick(start), solution, kept)
    return None if solution is None else replace(solution, timings=alike.spread(solution.timings))


def _rescale(
    program: Program, start: Sequence[Timing], solution: Solution, failures: list[Verdict]
) -> Solution:
    """Solve again from a solution whose effort is a small part of its start's, in which it was measured.

    What is far below one counts as nothing to the solver: a leg begun much too fast hides the others.
    """
    objective = program.objective
    if objective.separable or objective.scales_limits or program.weight is not None:
        return solution
    legs = program.repeat(program.demands)
    size = objective.scale(legs, program.repeat(start))
    for _ in range(RESCALED):
        reached = objective.scale(legs, program.repeat(solution.timings))
        if not 0 < reached < FALLEN * size or is_late():
            break
        better = _exchange(program, solution.timings, failures)
        if better is None or objective.scale(legs, program.repeat(better.timings)) > reached:
            break
        size, solution = reached, better
    return solution


def _exchange(
    program: Program,
    start: Sequence[Timing],
    failures: list[Verdict],
    enough: float = inf,
    most_rounds: int | None = None,
) -> Solution | None:
    """Solve, demand the limits where they are broken, and solve again."""
    variables = Variables(program, np.array([timing.duration for timing in start]))
    points, stay = list_points(program), list_stays(program)
    best: Solution | None = None
    x = begun = _begin(program, variables, start)
    scale = _measure_start(program, variables, start, begun)
    iterations = 0
    for rounds in range(1, (most_rounds or ROUNDS) + 1):
        rooms = list_rooms(program, points)
        transcription = transcribe(program, variables, points, rooms, stay, scale)
        outcome = solve(transcription.layout, x, transcription.numbers, strict=program.moving)
        iterations += outcome.iterations
        again = rounds > 1 and not program.large and not outcome.stopped
        if not _is_usable(outcome) and again:  # once more from where all began
            outcome = solve(transcription.layout, begun, transcription.numbers, strict=program.moving)
            iterations += outcome.iterations
        partial = outcome.stopped and program.elastic and program.objective.separable
        if not _is_usable(outcome) and not (partial and np.all(np.isfinite(outcome.x))):
            if not outcome.stopped:
                failures.append(outcome.verdict)
            return _give_up(best, iterations, Status.STOPPED if outcome.stopped else Status.ACCEPTABLE)
        found = variables.timings(outcome.x)
        try:
            timings, gap = _close(program, found, _used(program, outcome, scale))
        except InfeasibleError:
            return _give_up(best, iterations, Status.ACCEPTABLE)
        status = STATUSES.get(outcome.verdict, Status.ACCEPTABLE)
        solution = Solution(timings, status, iterations, rounds, gap, transcription.rows)
        best = _better(program, best, solution)
        if outcome.stopped:
            return replace(best, status=status)
        strayed = add_departures(stay, program, found)
        used = _used(program, outcome, scale)
        if _is_hopeless(program, found, gap, used, enough):
            break
        if not strayed and (gap <= GAP or not add_extrema(points, program, found, used)):
            break
        x = _go_on(program, variables, outcome.x, found, timings, gap)
    if best is not None and best.status is Status.OPTIMAL and best.gap > GAP:
        return replace(best, status=Status.GAP_LEFT)
    return best


def _is_hopeless(program: Program, found: Sequence[Timing], gap: float, used: float, enough: float) -> bool:
    """Whether more points lead nowhere: to a law too slow or rash, or to limits known to be broken."""
    if program.elastic and sum_durations(found) > enough:
        return True
    if program.objective.scales_limits and used > enough:
        return True
    return program.large and gap <= COARSE < used - 1


def _give_up(best: Solution | None, iterations: int, status: Status) -> Solution | None:
    """What the rounds before found, if they did."""
    return None if best is None else replace(best, status=status, iterations=iterations)


def _is_usable(outcome: Outcome) -> bool:
    return outcome.acceptable and bool(np.all(np.isfinite(outcome.x)))


def _begin(program: Program, variables: Variables, start: Sequence[Timing]) -> Array:
    """Variables of the start as the bases can write it: a spline only comes near another curve.

    A little inside the limits, where time may be stretched or the used part of the limits is a variable.
    """
    x = variables.pack(start, INSIDE)
    if not program.elastic:
        return x
    found = variables.timings(x)
    return _stretch_inside(variables, x, found, _scaled(program, found))


def _go_on(
    program: Program,
    variables: Variables,
    x: Array,
    found: Sequence[Timing],
    timings: Sequence[Timing],
    gap: float,
) -> Array:
    """Variables from which to solve again, of the last solution, as far inside the limits."""
    if program.elastic:
        return _stretch_inside(variables, x, found, timings)
    if program.objective.scales_limits:
        x = x.copy()
        x[-1] *= INSIDE * (1 + gap)
    return x


def _stretch_inside(
    variables: Variables, x: Array, found: Sequence[Timing], timings: Sequence[Timing]
) -> Array:
    """Variables x of timings that were `found`, in a little more than the times that they were brought to."""
    factors = [scaled.duration / own.duration for own, scaled in zip(found, timings, strict=True)]
    return variables.stretched(x, INSIDE * np.array(factors))


def _scaled(program: Program, timings: Sequence[Timing]) -> tuple[Timing, ...]:
    """Each run stretched to its limits, but for rounding."""
    scaled: list[Timing] = []
    for run in program.runs:
        scaled += scale_to_limits(run.demands, timings[len(scaled) : len(scaled) + len(run.demands)])
    return tuple(scaled)


def _prove(program: Program, solution: Solution | None) -> Solution | None:
    """The same, proved to hold its limits where time may be stretched; None if no stretch of time does it."""
    if solution is None or not program.elastic:
        return solution
    held: list[Timing] = []
    try:
        for run in program.runs:
            held += hold_limits(run.demands, solution.timings[len(held) : len(held) + len(run.demands)])
    except InfeasibleError:
        return None
    return replace(solution, timings=tuple(held))


def _measure_start(program: Program, variables: Variables, start: Sequence[Timing], begun: Array) -> float:
    """The size of the objective at the start, if it enters the program."""
    if program.elastic:
        return 1.0
    of = variables.timings(begun) if program.objective.scales_limits else start
    return program.objective.scale(program.repeat(program.demands), program.repeat(of))


def _used(program: Program, outcome: Outcome, scale: float) -> float:
    """The part of the limits that the program allowed itself."""
    return float(outcome.x[-1]) * scale if program.objective.scales_limits else 1.0


def _close(program: Program, found: tuple[Timing, ...], allowed: float) -> tuple[tuple[Timing, ...], float]:
    """Timings after the exact stretch, where there is one, and the gap that is left."""
    if program.elastic:
        timings = _scaled(program, found)
        return timings, sum_durations(timings) / sum_durations(found) - 1
    excess = used_fraction(program.demands, found) / allowed - 1
    return found, excess if program.objective.scales_limits else excess + GAP  # within the margin, no gap


def _better(program: Program, best: Solution | None, found: Solution) -> Solution:
    """For least time the faster of two laws within the limits, else the one that exceeds them less."""
    if best is None or not program.elastic:
        return found
    return (
        found
        if found.duration <= best.duration
        else replace(best, gap=best.duration / found.duration - 1 + found.gap)
    )
