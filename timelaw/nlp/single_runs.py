"""Solve every distinct run of a route once."""

from collections.abc import Iterator, Sequence

from timelaw.nlp.elastic_runs import solve_elastic
from timelaw.nlp.given_runs import solve_given
from timelaw.nlp.program import RunProblem
from timelaw.nlp.solution import Solution, Timings
from timelaw.progress import Progress


def solve_runs(problems: Sequence[RunProblem], progress: Progress | None = None) -> Timings:
    """Least-time solutions of all runs."""
    return assign_solutions(problems, list(solve_distinct(problems, progress)))


def solve_distinct(problems: Sequence[RunProblem], progress: Progress | None = None) -> Iterator[Solution]:
    """Solutions of the distinct runs; `progress` hears of those solved, and how many there are."""
    distinct = list({problem.key(): problem for problem in problems}.values())
    for index, problem in enumerate(distinct):
        if progress is not None:
            progress("solving distinct runs", index, len(distinct))
        yield solve_run(problem)


def assign_solutions(problems: Sequence[RunProblem], solutions: Sequence[Solution]) -> Timings:
    """The solution of each run from those of the distinct ones, in the order in which these first appear."""
    keys = [problem.key() for problem in problems]
    distinct = list(dict.fromkeys(keys))
    of_run = tuple(distinct.index(key) for key in keys)
    timings = tuple(timing for index in of_run for timing in solutions[index].timings)
    return Timings(timings, tuple(solutions), of_run)


def solve_run(problem: RunProblem) -> Solution:
    """The fastest law over a run.

    Raises:
        InfeasibleError: a run with given times or rates has no solution.
    """
    return solve_elastic(problem) if problem.elastic else solve_given(problem)
