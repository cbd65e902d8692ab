"""Solve every distinct run of a route once."""

from collections.abc import Sequence

from timelaw.nlp.elastic_runs import solve_elastic
from timelaw.nlp.given_runs import solve_given
from timelaw.nlp.program import RunProblem
from timelaw.nlp.solution import Solution, Timings
from timelaw.progress import Progress


def solve_runs(problems: Sequence[RunProblem], progress: Progress | None = None) -> Timings:
    """Least-time solutions of all runs; `progress` hears of distinct runs solved, and how many there are."""
    keys = [problem.key() for problem in problems]
    distinct = list(dict.fromkeys(keys))
    solutions = []
    for index, key in enumerate(distinct):
        if progress is not None:
            progress("solving distinct runs", index, len(distinct))
        solutions.append(solve_run(problems[keys.index(key)]))
    of_run = tuple(distinct.index(key) for key in keys)
    timings = tuple(timing for index in of_run for timing in solutions[index].timings)
    return Timings(timings, tuple(solutions), of_run)


def solve_run(problem: RunProblem) -> Solution:
    """The fastest law over a run.

    Raises:
        InfeasibleError: a run with given times or rates has no solution.
    """
    return solve_elastic(problem) if problem.elastic else solve_given(problem)
