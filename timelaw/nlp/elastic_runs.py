"""Runs from rest to rest whose time may be stretched: the solver, falling back where it fails."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import inf

from timelaw.easing import Timing, smoothstep
from timelaw.nlp.program import Program, RunProblem
from timelaw.nlp.solution import Solution, Status
from timelaw.nlp.verdicts import Verdict
from timelaw.time_limit import is_late

SAME_TIME = 2e-6  # relative: the gap that the solver is left with, and where the closed form is the optimum


def solve_elastic(problem: RunProblem, enough: float = inf) -> Solution:
    """The best of: the program from the closed form over the run, from stops at each node, closed form.

    Once it is clear that it takes more than `enough` [s] no better one is looked for. A solver's word is not
    taken: its law counts only if, stretched to hold the limits, it is at least as fast as the closed-form
    law, which the basis contains.
    """
    from timelaw.nlp.exchange import solve_from  # loads CasADi, which `timelaw verify` has no need of

    known = _closed_form(problem)
    if known.status is not Status.CLOSED_FORM:
        return known
    program, found, failures = Program((problem,)), list[Solution](), list[Verdict]()
    for status, start in list_starts(problem):
        solution = solve_from(program, start, failures, enough)
        if solution is None:
            continue
        if solution.duration > enough and solution.status in (Status.OPTIMAL, Status.GAP_LEFT):
            return _fastest([solution, known], known)
        optimal = solution.status is Status.OPTIMAL
        found.insert(0, replace(solution, status=status) if optimal else solution)
        if optimal and _plausible(solution, known):
            return _fastest(found, known)
    if not found and not is_late():
        found += _from_simpler(problem, program)
    best = _fastest([*found, replace(known, failures=tuple(failures))], known)
    return replace(best, status=Status.STOPPED) if is_late() else best


def _fastest(found: Sequence[Solution], known: Solution) -> Solution:
    """Of the plausible solutions the fastest."""
    plausible = [solution for solution in found if _plausible(solution, known)]
    return min(plausible, key=lambda solution: solution.duration)


def _closed_form(problem: RunProblem) -> Solution:
    """The law in closed form, whose status says if nothing is left to be found."""
    whole = problem.family.closed_form(problem.demands)
    known = Solution(whole, Status.CLOSED_FORM)
    if problem.family.rigid:
        return replace(known, status=Status.CHOSEN)
    if known.duration <= problem.run.limit * (1 + SAME_TIME):
        return replace(known, status=Status.PHYSICAL_LIMIT)
    if not problem.bases[0].free and len(problem.demands) == 1:
        return replace(known, status=Status.OPTIMAL)
    return known


def list_starts(problem: RunProblem) -> Iterator[tuple[Status, Sequence[Timing]]]:
    """Where the solver begins, and what an optimum is called that it finds from there.

    The family's own start; then smoothsteps that stop at each node, in twice their least time: deep
    inside the limits.
    """
    yield Status.OPTIMAL, problem.family.start(problem.demands)
    slow = [smoothstep.time_leg(demand, problem.family.continuity) for demand in problem.demands]
    yield Status.SECOND_START, [timing.stretched(2.0) for timing in slow]


def _from_simpler(problem: RunProblem, program: Program) -> list[Solution]:
    """From the solution of a simpler family, which this one contains; that itself if it gets no better."""
    from timelaw.nlp.exchange import solve_from

    simpler = problem.family.simpler()
    if simpler is None:
        return []
    known = solve_elastic(replace(problem, family=simpler))
    if known.status is Status.CLOSED_FORM:
        return []
    found = solve_from(program, known.timings)
    if found is None or found.duration > known.duration:
        return [replace(known, status=Status.SIMPLER)]
    return [replace(found, status=Status.SIMPLER) if found.status is Status.OPTIMAL else found]


def _plausible(solution: Solution, fallback: Solution) -> bool:
    """At least as fast as the closed form."""
    return solution.duration <= fallback.duration * (1 + SAME_TIME)
