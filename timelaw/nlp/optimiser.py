"""The law that makes the objective least: runs one by one, then all together where something ties them."""

from collections.abc import Sequence

from timelaw.easing import Timing
from timelaw.easing.family import Family
from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.all_runs import list_deadlines, solve_together, solve_weighed
from timelaw.nlp.family_choice import list_run_problems, solve_least_within
from timelaw.nlp.single_runs import assign_solutions
from timelaw.nlp.solution import Timings, sum_durations
from timelaw.objectives import OBJECTIVES
from timelaw.problem import Problem
from timelaw.progress import Progress
from timelaw.requirements import Requirements
from timelaw.route import Route

SAME_DURATION = 1e-9


def optimise(
    problem: Problem, route: Route, requirements: Requirements, progress: Progress | None = None
) -> tuple[Family, Timings]:
    """The timings that make a problem's objective least on its route, and the family they are of.

    Of several families the first is taken whose least time comes near enough to the physical limit, or
    else the fastest.

    Raises:
        InfeasibleError: the requirements cannot be met.
    """
    goal = problem.objective
    family, least = solve_least_within(problem, route, requirements, progress)
    runs = list_run_problems(route, requirements, family)
    given = list_deadlines(route, requirements, goal, sum_durations(least.timings) + requirements.dwell_time)
    if OBJECTIVES[goal.minimise].separable and not given:
        _check_durations(requirements, least.timings)
        return family, least
    if goal.weight is not None and not given:
        solutions = solve_weighed(runs, least.timings, goal)
        timings = assign_solutions(runs, solutions)
        _check_durations(requirements, timings.timings)
        return family, timings
    if progress is not None:
        progress("solving all runs together", len(least.solutions), len(least.solutions) + 1)
    solution = solve_together(runs, least.timings, goal, given)
    _check_durations(requirements, solution.timings)
    return family, Timings(solution.timings, (solution,), (0,) * len(runs))


def _check_durations(requirements: Requirements, timings: Sequence[Timing]) -> None:
    """Fixed durations are kept, whatever solved the program."""
    for demand, timing in zip(requirements.demands, timings, strict=True):
        if demand.duration is not None and abs(timing.duration / demand.duration - 1) > SAME_DURATION:
            message = f"{timing.duration:.9g} s came out where {demand.duration:.9g} s are fixed"
            raise InfeasibleError(Fault(message, "segments"))
