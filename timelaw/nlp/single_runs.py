"""Solve every distinct run of a route once: plain legs together, others one by one."""

from collections.abc import Callable, Iterator, Sequence
from math import inf

from timelaw.easing import smoothstep
from timelaw.easing.polynomial_basis import PolynomialBasis
from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.elastic_runs import solve_elastic
from timelaw.nlp.given_runs import solve_given
from timelaw.nlp.program import RunProblem
from timelaw.nlp.solution import GAP, Solution, Status, Timings
from timelaw.progress import Progress
from timelaw.single_legs.least_times import are_rates_limited, solve_legs
from timelaw.time_limit import is_late

Solved = dict[RunProblem, Solution]
TOGETHER = 500  # legs, after which the clock is looked at: less than a second, with degree 31 two


def solve_runs(
    problems: Sequence[RunProblem], progress: Progress | None = None, solved: Solved | None = None
) -> Timings:
    """Least-time solutions of all runs."""
    return assign_solutions(problems, list(solve_distinct(problems, progress, solved=solved)))


def solve_distinct(
    problems: Sequence[RunProblem],
    progress: Progress | None = None,
    enough: Callable[[RunProblem], float] = lambda _: inf,
    solved: Solved | None = None,
) -> Iterator[Solution]:
    """Solutions of the distinct runs; `progress` hears of those solved, and how many there are.

    Of a run that takes more than `enough` [s], asked for as its turn comes, no better one is looked for. What
    is `solved` is not solved again; what is found joins it.

    Raises:
        InfeasibleError: a run with given times or rates has no solution; how many were not tried is told.
    """
    distinct = list({problem.key(): problem for problem in problems}.values())
    plain = [p for p in distinct if _find_polynomials(p) and p not in (solved or {})]
    together: Solved = {}
    for index, problem in enumerate(distinct):
        if progress is not None:
            progress("solving distinct runs", index, len(distinct))
        found = (solved or {}).get(problem)
        try:
            most = enough(problem)
            if plain and problem is plain[0]:
                together, plain = solve_plain(plain[:TOGETHER]), plain[TOGETHER:]
            found = found or together.get(problem) or solve_run(problem, most)
        except InfeasibleError as error:
            untried = sum(not other.elastic for other in distinct[index + 1 :])
            what = "run" if untried == 1 else "runs"
            more = [Fault(f"not tried: {untried} more {what} with given durations or rates")]
            raise InfeasibleError(*error.faults, *(more if untried else [])) from None
        if solved is not None and (not problem.elastic or found.duration <= most or is_late()):
            solved[problem] = found
        yield found


def _find_polynomials(problem: RunProblem) -> PolynomialBasis | None:
    """The polynomials of a plain run."""
    return problem.family.polynomials if is_plain(problem) else None


def is_plain(problem: RunProblem) -> bool:
    """Whether it is one leg from rest to rest, under nothing but limits on rates."""
    return problem.elastic and len(problem.demands) == 1 and are_rates_limited(problem.demands[0])


def solve_plain(problems: Sequence[RunProblem]) -> Solved:
    """Least-time solutions of plain runs of one family, without those that rounding keeps from it.

    Where the time is over they are smoothsteps.
    """
    basis, legs = _find_polynomials(problems[0]), [problem.demands[0] for problem in problems]
    if basis is None:
        return {}
    if is_late():
        slow = smoothstep.time_legs(legs, basis.continuity)
        return {p: Solution((timing,), Status.STOPPED) for p, timing in zip(problems, slow, strict=True)}
    return {
        problem: Solution((leg.timing,), Status.OPTIMAL, leg.exchanges, 1, leg.gap, leg.rows)
        for problem, leg in zip(problems, solve_legs(legs, basis), strict=True)
        if leg is not None and leg.gap <= GAP
    }


def assign_solutions(problems: Sequence[RunProblem], solutions: Sequence[Solution]) -> Timings:
    """The solution of each run from those of the distinct ones, in the order in which these first appear."""
    first: dict[object, int] = {}
    of_run = tuple(first.setdefault(problem.key(), len(first)) for problem in problems)
    timings = tuple(timing for index in of_run for timing in solutions[index].timings)
    return Timings(timings, tuple(solutions), of_run)


def solve_run(problem: RunProblem, enough: float = inf) -> Solution:
    """The fastest law over a run; any law once it is clear that the fastest takes more than `enough` [s].

    Raises:
        InfeasibleError: a run with given times or rates has no solution.
    """
    return solve_elastic(problem, enough) if problem.elastic else solve_given(problem)
