"""Runs that time cannot be stretched on: legs of fixed duration, and motions that begin or end moving."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from math import inf

from timelaw.easing import Timing
from timelaw.easing.family import PolynomialFamily
from timelaw.easing.time_scaling import used_fraction
from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.elastic_runs import SAME_TIME, list_starts
from timelaw.nlp.end_checks import check_ends
from timelaw.nlp.known_laws import is_least, list_known, stop_in_time
from timelaw.nlp.least_peaks import find_least_peak, holds_limits
from timelaw.nlp.program import FARTHEST, Program, RunProblem
from timelaw.nlp.solution import Solution, Status, sum_durations
from timelaw.nlp.verdicts import Verdict
from timelaw.time_limit import is_late

LEAST_MARGIN = 1e-8  # of the limits, where a greater one leaves no room
TIME_OVER = "the time limit ended the search before any law was found; give more with --time-limit"
KEPT = 8  # runs whose poorest law is remembered, while one family after the other is tried
SHOWN = 1e-5  # relative; a factor nearer to one is written with more digits


def solve_given(problem: RunProblem) -> Solution:
    """The fastest law found that holds the limits: the solver's, or one that is known to hold them.

    On the arcs, or where there is none, beyond them.

    Raises:
        InfeasibleError: none was found; with the least factor by which the limits would have to be larger.
    """
    program = Program((problem,))
    known = min(list_known(problem), key=lambda solution: solution.duration, default=None)
    if known is not None and known.status is Status.STEADY and is_least(problem, known):
        return known
    stays = check_ends(problem)
    starts = _list_starts(problem)
    if known:
        place = 0 if program.large else len(starts)
        starts.insert(place, (Status.SECOND_START, known.timings))
    first = starts if known else starts[:1]  # where the first one fails, the others mostly do: they come last
    solved = _solve_from_all(program, first, known) if stays else []
    if stays and not solved and known is None:
        solved = _solve_from_least(problem, program) or _solve_from_all(program, starts[1:], None)
    if solved or known:
        best = min([*solved, *([known] if known else [])], key=lambda solution: solution.duration)
        optimal = best.status in (Status.OPTIMAL, Status.SECOND_START)
        return replace(best, status=Status.STOPPED) if is_late() and not optimal else best
    known_factors = [] if problem.run.moving else [used_fraction(problem.demands, stop_in_time(problem))]
    return solve_from_peak(program, [s for _, s in starts], problem.where, known_factors, stays=stays)


def _list_starts(problem: RunProblem) -> list[tuple[Status, Sequence[Timing]]]:
    """Where the solver begins: as from rest to rest, and faster where the mean speed of the ends is."""
    starts = list(list_starts(problem))
    first, mean = starts[0][1], sum(problem.run.speeds) / 2
    if mean * sum_durations(first) > problem.run.angle:
        factor = problem.run.angle / mean / sum_durations(first)
        starts.append((Status.SECOND_START, [timing.stretched(factor) for timing in first]))
    return starts


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


def _solve_from_least(problem: RunProblem, program: Program) -> list[Solution]:
    """From the law of the polynomials that have nothing but the rates at their nodes to choose.

    Only where that stays on the arcs; itself too, if the family contains it.
    """
    from timelaw.nlp.exchange import solve_from

    r = problem.family.continuity
    least = PolynomialFamily(2 * r + 1, r)
    if problem.family == least:
        return []
    simple = _solve_simplest(replace(problem, family=least))
    if is_late():  # what a time limit cut short is remembered for no one
        _solve_simplest.cache_clear()
    if simple is None:
        return []
    found = solve_from(program, simple.timings)
    solved = [replace(simple, status=Status.SIMPLER)] if problem.family.contains(least.degree) else []
    if found is not None and holds_limits(program, found):
        solved.append(replace(found, status=Status.SIMPLER) if found.status is Status.OPTIMAL else found)
    return solved


@lru_cache(maxsize=KEPT)
def _solve_simplest(problem: RunProblem) -> Solution | None:
    """The law over a run of the poorest family, for all richer ones to begin from."""
    starts, program = _list_starts(problem), Program((problem,))
    laws = _solve_from_all(program, starts, None)
    simple = min(laws, key=lambda solution: solution.duration, default=None)
    if simple is not None:
        return simple
    on_arcs = replace(program, margin=LEAST_MARGIN)
    return _solve_from_peak(on_arcs, [start for _, start in starts], [], [], again=False)


def solve_from_peak(
    program: Program,
    starts: Sequence[Sequence[Timing]],
    where: str,
    known_factors: Sequence[float] = (),
    *,
    stays: bool = True,
) -> Solution:
    """From the law that uses the least part of the limits; that law itself where nothing better is found.

    `known_factors` are parts of the limits, more than all of them, that laws in closed form use.

    First on the arcs, with hardly any margin, unless it is known that no law `stays` there; then beyond them.

    Raises:
        InfeasibleError: the least part that was found is more than all of them, or the time is over.
    """
    factors = list(known_factors)
    failures: list[Verdict] = []
    tries = (replace(program, margin=LEAST_MARGIN), replace(program, beyond=FARTHEST))
    for tried in tries if stays else tries[1:]:
        found = _solve_from_peak(tried, starts, factors, failures)
        if is_late():
            raise InfeasibleError(Fault(TIME_OVER, where))
        if found is not None:
            return found
    fault = _explain(program, starts, factors, failures, where)
    raise InfeasibleError(Fault(TIME_OVER, where) if is_late() else fault)


def _solve_from_peak(
    program: Program,
    starts: Sequence[Sequence[Timing]],
    factors: list[float],
    failures: list[Verdict],
    *,
    again: bool = True,
) -> Solution | None:
    """The best law from there that holds the limits; else None, and in `factors` the part of them it uses.

    Or from one of the starts, if they are to be tried `again`.
    """
    from timelaw.nlp.exchange import solve_from

    enough = inf if program.large else 1 + SHOWN  # of a large program the factor is not looked for again
    least = find_least_peak(program, starts, failures, enough)
    if least is None or is_late():
        return None
    used = used_fraction(program.demands, least.timings)
    factors.append(used)
    if used > 1 + SHOWN:
        return None
    found = [solve_from(program, start) for start in (least.timings, *(starts if again else ()))]
    solved = [solution for solution in found if solution is not None and holds_limits(program, solution)]
    if solved:
        fastest = min(solved, key=lambda solution: solution.duration)
        best = fastest if program.objective.separable else solved[0]
        return replace(best, status=Status.BEYOND if program.beyond else Status.SECOND_START)
    if used <= 1:
        return replace(least, status=Status.BEYOND if program.beyond else Status.LEAST_PEAK)
    return None


def _explain(
    program: Program,
    starts: Sequence[Sequence[Timing]],
    factors: list[float],
    failures: list[Verdict],
    where: str,
) -> Fault:
    """By how much the limits would have to give, however far the body ran beyond its nodes, if that helps."""
    known = program.large and bool(factors)
    anywhere = None if known else find_least_peak(replace(program, beyond=inf), starts, failures)
    if anywhere is not None and not holds_limits(program, anywhere):
        factors = [*factors, used_fraction(program.demands, anywhere.timings)]
    if not factors:
        ends = "".join(f"; IPOPT: {verdict.value}: {verdict.remedy}" for verdict in dict.fromkeys(failures))
        return Fault(f"the solver found no law; give more time or another degree{ends}", where)
    used = min(factors)
    times = f"{used:.6g}" if used > 1 + SHOWN else f"{used:.12g}"
    message = f"{_name_given(program)} the limits would have to be {times} times as large"
    return Fault(message, where)


def _name_given(program: Program) -> str:
    """What leaves the limits no room."""
    if program.budgets:
        return "within the given times"
    fixed = any(demand.duration is not None for demand in program.demands)
    return "within the given durations" if fixed else "with the given rates at its ends"
