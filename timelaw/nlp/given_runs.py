"""Runs that time cannot be stretched on: legs of fixed duration, and motions that begin or end moving."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from timelaw.easing import Profile, Timing
from timelaw.easing.family import Family
from timelaw.easing.time_scaling import used_fraction
from timelaw.errors import Fault, InfeasibleError
from timelaw.limits import Demand
from timelaw.nlp.elastic_runs import SAME_TIME, list_starts, solve_elastic
from timelaw.nlp.program import LEAST_PEAK, Program, RunProblem
from timelaw.nlp.solution import Solution, Status
from timelaw.requirements.given_times import find_stretch

SAME_RATE = 1e-9  # relative: a run entered and left at one speed
PACES = (1.0, 0.5, 2.0)  # of a start: a moving run may take less or more time than one from rest to rest
SHOWN = 1e-5  # relative; a factor nearer to one is written with more digits


def solve_given(problem: RunProblem) -> Solution:
    """The fastest law found that holds the limits: the solver's, or one that is known to hold them.

    On the arcs, or where there is none, beyond them.

    Raises:
        InfeasibleError: none was found; with the least factor by which the limits would have to be larger.
    """
    program = Program((problem,))
    known = min(list_known(problem), key=lambda solution: solution.duration, default=None)
    if known is not None and known.status is Status.STEADY and _is_least(problem, known):
        return known
    starts = list(list_starts(problem)) + ([(Status.SECOND_START, known.timings)] if known else [])
    solved = _solve_from_all(program, starts, known)
    if solved or known:
        return min([*solved, *([known] if known else [])], key=lambda solution: solution.duration)
    solved = _solve_from_all(replace(program, on_arcs=False), starts, None)
    if solved:
        return replace(solved[-1], status=Status.BEYOND)
    return solve_from_peak(program, [start for _, start in starts], problem.where)


def _solve_from_all(
    program: Program, starts: Sequence[tuple[Status, Sequence[Timing]]], known: Solution | None
) -> list[Solution]:
    """Solutions that hold the limits, until one is optimal and no slower than the law that is known."""
    from timelaw.nlp.exchange import solve_from

    solved: list[Solution] = []
    for status, start in starts:
        solution = solve_from(program, start)
        if solution is not None and holds_limits(program, solution):
            optimal = solution.status is Status.OPTIMAL
            solved.append(replace(solution, status=status) if optimal else solution)
            if optimal and (known is None or solution.duration <= known.duration * (1 + SAME_TIME)):
                return solved[-1:]
    return solved


def _is_least(problem: RunProblem, solution: Solution) -> bool:
    """As fast as physics allows."""
    return solution.duration <= problem.run.limit * (1 + SAME_TIME)


def solve_from_peak(program: Program, starts: Sequence[Sequence[Timing]], where: str) -> Solution:
    """From the law that uses the least part of the limits; that law itself where nothing better is found.

    Raises:
        InfeasibleError: the least part that was found is more than all of them.
    """
    from timelaw.nlp.exchange import solve_from

    least = find_least_peak(program, starts)
    if least is None or not holds_limits(program, least):
        program = replace(program, on_arcs=False)
        least = find_least_peak(program, starts)
    if least is None:
        raise InfeasibleError(Fault("the solver found no law; give more time or another degree", where))
    used = used_fraction(program.demands, least.timings)
    if used > 1:
        times = f"{used:.6g}" if used > 1 + SHOWN else f"{used:.12g}"
        message = f"{_name_given(program)} the limits would have to be {times} times as large"
        raise InfeasibleError(Fault(message, where))
    solution = solve_from(program, least.timings)
    if solution is not None and holds_limits(program, solution):
        return replace(solution, status=Status.SECOND_START if program.on_arcs else Status.BEYOND)
    return replace(least, status=Status.LEAST_PEAK if program.on_arcs else Status.BEYOND)


def find_least_peak(program: Program, starts: Sequence[Sequence[Timing]]) -> Solution | None:
    """The law that uses the least part of the limits, of all starts at several paces; None for none."""
    from timelaw.nlp.exchange import solve_from

    peaks = replace(program, objective=LEAST_PEAK, weight=None)
    best: tuple[float, Solution] | None = None
    for pace in PACES:
        for start in starts:
            solution = solve_from(peaks, [timing.stretched(pace) for timing in start])
            if solution is None:
                continue
            used = used_fraction(program.demands, solution.timings)
            if best is None or used < best[0]:
                best = used, solution
            if used <= 1:
                return solution
    return None if best is None else best[1]


def _name_given(program: Program) -> str:
    """What leaves the limits no room."""
    if program.budgets:
        return "within the given times"
    fixed = any(demand.duration is not None for demand in program.demands)
    return "within the given durations" if fixed else "with the given rates at its ends"


def list_known(problem: RunProblem) -> Iterator[Solution]:
    """Laws that hold the limits and need no solver of the whole run: a steady turn; a stop at every node."""
    demands = problem.demands
    if problem.run.moving:
        steady = _turn_steadily(problem)
        if steady and used_fraction(demands, steady) <= 1:
            yield Solution(steady, Status.STEADY)
        return
    timings = stop_at_nodes(demands, [problem.family] * len(demands))
    if used_fraction(demands, timings) <= 1:
        yield Solution(timings, Status.STOPS if len(demands) > 1 else Status.AT_MINIMUM)


def stop_at_nodes(demands: Sequence[Demand], families: Sequence[Family]) -> tuple[Timing, ...]:
    """Every leg from rest to rest in its least time, or in its own where that is fixed."""
    known: dict[object, Timing] = {}
    timings = []
    for demand, family in zip(demands, families, strict=True):
        if demand.key() not in known:
            leg = RunProblem((replace(demand, duration=None),), family)
            (timing,) = solve_elastic(leg).timings
            if demand.duration is not None:
                timing = timing.stretched(find_stretch(demand.duration, timing.duration))
            known[demand.key()] = timing
        timings.append(known[demand.key()])
    return tuple(timings)


def _turn_steadily(problem: RunProblem) -> tuple[Timing, ...]:
    """At the speed of both ends all along, where they are one; empty where that is not so."""
    start, end = problem.run.speeds
    others = (*problem.start[1:], *problem.end[1:])
    given = any(demand.duration is not None for demand in problem.demands)
    if given or any(others) or not start or abs(start - end) > SAME_RATE * start:
        return ()
    order = problem.family.continuity
    return tuple(
        Timing(demand.angle / start, Profile.single(np.linspace(0.0, 1.0, order + 2), order))
        for demand in problem.demands
    )


def holds_limits(program: Program, solution: Solution) -> bool:
    """Whether the law holds every limit of the program, proved."""
    return used_fraction(program.demands, solution.timings) <= 1
