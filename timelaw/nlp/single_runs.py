"""Solve every distinct run of a route once."""

from collections.abc import Callable, Iterator, Sequence
from math import inf

from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.elastic_runs import solve_elastic
from timelaw.nlp.given_runs import solve_given
from timelaw.nlp.program import RunProblem
from timelaw.nlp.solution import Solution, Timings
from timelaw.progress import Progress
from timelaw.time_limit import is_late

Solved = dict[RunProblem, Solution]


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
    for index, problem in enumerate(distinct):
        if progress is not None:
            progress("solving distinct runs", index, len(distinct))
        found = (solved or {}).get(problem)
        try:
            most = enough(problem)
            found = found or solve_run(problem, most)
        except InfeasibleError as error:
            untried = sum(not other.elastic for other in distinct[index + 1 :])
            what = "run" if untried == 1 else "runs"
            more = [Fault(f"not tried: {untried} more {what} with given durations or rates")]
            raise InfeasibleError(*error.faults, *(more if untried else [])) from None
        if solved is not None and (not problem.elastic or found.duration <= most or is_late()):
            solved[problem] = found
        yield found


def assign_solutions(problems: Sequence[RunProblem], solutions: Sequence[Solution]) -> Timings:
    """The solution of each run from those of the distinct ones, in the order in which these first appear."""
    keys = [problem.key() for problem in problems]
    distinct = list(dict.fromkeys(keys))
    of_run = tuple(distinct.index(key) for key in keys)
    timings = tuple(timing for index in of_run for timing in solutions[index].timings)
    return Timings(timings, tuple(solutions), of_run)


def solve_run(problem: RunProblem, enough: float = inf) -> Solution:
    """The fastest law over a run; any law once it is clear that the fastest takes more than `enough` [s].

    Raises:
        InfeasibleError: a run with given times or rates has no solution.
    """
    return solve_elastic(problem, enough) if problem.elastic else solve_given(problem)
