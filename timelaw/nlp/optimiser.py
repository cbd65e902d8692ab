"""The law that makes the objective least: runs one by one, then all together where something ties them."""

from collections.abc import Sequence

from timelaw.easing import Timing
from timelaw.easing.family import Family
from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.all_runs import list_deadlines, solve_together
from timelaw.nlp.program import RunProblem
from timelaw.nlp.single_runs import solve_runs
from timelaw.nlp.solution import Timings, sum_durations
from timelaw.objectives import OBJECTIVES
from timelaw.problem import Problem
from timelaw.progress import Progress
from timelaw.requirements import Requirements
from timelaw.route import Route

SAME_DURATION = 1e-9


def list_run_problems(route: Route, requirements: Requirements, family: Family) -> list[RunProblem]:
    """The runs of a route with what is demanded on them."""
    return [
        RunProblem(run.demands, family, run.start, run.end, run.where) for run in requirements.by_run(route)
    ]


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
    family, least = _least_within(problem, route, requirements, progress)
    runs = list_run_problems(route, requirements, family)
    given = list_deadlines(route, requirements, goal, sum_durations(least.timings) + requirements.dwell_time)
    if OBJECTIVES[goal.minimise].separable and not given:
        _check_durations(requirements, least.timings)
        return family, least
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


def _least_within(
    problem: Problem, route: Route, requirements: Requirements, progress: Progress | None
) -> tuple[Family, Timings]:
    """The first family whose least time is near enough to the physical limit, or the fastest one."""
    kind, easing = problem.easing.kind, problem.easing
    enough = sum(run.limit for run in requirements.by_run(route)) * (1 + kind.allowed_excess(easing))
    best: tuple[Family, Timings] | None = None
    for family in kind.families(easing, problem.nodes.continuity):
        least = solve_runs(list_run_problems(route, requirements, family), progress)
        if best is None or sum_durations(least.timings) < sum_durations(best[1].timings):
            best = family, least
        if sum_durations(best[1].timings) <= enough:
            break
    if best is None:
        raise ValueError("no family of easings was given")
    return best
