"""Solve every distinct run of a route once, falling back where the solver fails."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from timelaw.easing import PolynomialBasis, Timing, fit_to_limits, smoothstep
from timelaw.limits import Rate
from timelaw.nlp.run_problem import RunProblem, RunSolution, Status
from timelaw.route import Route

SAME_ANGLE = 1e-9  # rad; legs of a lattice agree to 1e-15


@dataclass(frozen=True)
class Optimised:
    """Solutions of the distinct runs, and which of them each run of the route uses."""

    solutions: tuple[RunSolution, ...]
    of_run: tuple[int, ...]


def optimise(
    route: Route,
    limits: tuple[Rate, ...],
    basis: PolynomialBasis,
    objective: str = "time",
    progress: Callable[[str, int, int], None] | None = None,
) -> Optimised:
    """Least-time solutions of all runs; `progress` hears of distinct runs solved, and how many there are."""
    runs = route.runs
    keys = [tuple(round(angle / SAME_ANGLE) for angle in run.angles) for run in runs]
    distinct = list(dict.fromkeys(keys))
    solutions = []
    for index, key in enumerate(distinct):
        if progress is not None:
            progress("solving distinct runs", index, len(distinct))
        problem = RunProblem(runs[keys.index(key)].angles, limits, basis, objective)
        solutions.append(solve_run(problem))
    return Optimised(tuple(solutions), tuple(distinct.index(key) for key in keys))


def solve_run(problem: RunProblem) -> RunSolution:
    """The best of: the program from the smoothstep over the run, from stops at each node, closed form.

    A solver's word is not taken: its law counts only if, stretched to hold the limits, it is at
    least as fast as the closed-form law, which the basis contains.
    """
    from timelaw.nlp.exchange import solve_from  # loads CasADi, which `timelaw verify` has no need of

    r = problem.basis.continuity
    whole = fit_to_limits(
        problem.angles, smoothstep.run_timings(problem.angles, problem.limits, r), problem.limits
    )
    total = sum(timing.duration for timing in whole)
    fallback = RunSolution(whole, Status.CLOSED_FORM, bound=total)
    if not problem.basis.free and len(problem.angles) == 1:
        return replace(fallback, status=Status.OPTIMAL)
    first = solve_from(problem, whole)
    if first is not None and first.duration <= fallback.duration and first.status is Status.OPTIMAL:
        return first
    second = solve_from(problem, _second_start(problem))
    if second is not None and second.status is Status.OPTIMAL:
        second = replace(second, status=Status.SECOND_START)
    return min((s for s in (second, first, fallback) if s is not None), key=lambda s: s.duration)


def _second_start(problem: RunProblem) -> Sequence[Timing]:
    """Smoothsteps that stop at each node, in twice their least time: deep inside the limits."""
    stops = [
        smoothstep.leg_timing(angle, problem.limits, problem.basis.continuity) for angle in problem.angles
    ]
    return [timing.stretched(2.0) for timing in stops]
