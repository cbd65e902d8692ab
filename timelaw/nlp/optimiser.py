"""The law that makes the objective least: runs one by one, then all together where something ties them."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

from timelaw.easing import Timing
from timelaw.easing.family import Family
from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.all_runs import list_deadlines, solve_together, solve_weighed
from timelaw.nlp.program import Program, RunProblem
from timelaw.nlp.single_runs import Solved, assign_solutions, solve_distinct, solve_runs
from timelaw.nlp.solution import Solution, Timings, sum_durations
from timelaw.objectives import OBJECTIVES
from timelaw.problem import Problem
from timelaw.progress import Progress
from timelaw.requirements import Requirements
from timelaw.route import Route
from timelaw.time_limit import is_late

SAME_DURATION = 1e-9
PROBES = 4  # of the families, poorest first, that are tried where the poorest cannot do what is given


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


def _least_within(
    problem: Problem, route: Route, requirements: Requirements, progress: Progress | None
) -> tuple[Family, Timings]:
    """The first family whose least time is near enough to the physical limit, or else the nearest.

    A family is given up as soon as its first runs take more than all of them may; which one is the nearest is
    judged by the runs that were solved. The search ends at families too large for a run of so many legs; and
    where runs begin or end moving, or have times, at one that gains less than half of what is near enough:
    there the limit is one that need not be reached by any law. When the time is over, the family at hand is
    taken.
    """
    kind, easing = problem.easing.kind, problem.easing
    limit, within = sum(run.limit for run in requirements.by_run(route)), kind.allowed_excess(easing)
    families = list(kind.families(easing, problem.nodes.continuity))
    nearest, least_excess = families[0], inf
    solved: Solved = {}
    if len(families) > 1:
        families = list(_drop_infeasible(families, route, requirements, solved))
        nearest = families[0]
    for family in families if len(families) > 1 else ():
        runs = list_run_problems(route, requirements, family)
        if family != families[0] and any(Program((run,)).large for run in runs):
            continue
        solutions, excess = _solve_within(runs, limit * within, progress, solved)
        if solutions:
            return family, assign_solutions(runs, solutions)
        gained = least_excess - excess
        if gained > 0:
            nearest, least_excess = family, excess
        if gained < within / 2 and not all(run.elastic for run in runs):
            break
    return nearest, solve_runs(list_run_problems(route, requirements, nearest), progress, solved)


def _drop_infeasible(
    families: Sequence[Family], route: Route, requirements: Requirements, solved: Solved
) -> Sequence[Family]:
    """The families from the first one on that can do what is given.

    A richer one may hold limits that a poorer one cannot, of which some are tried; what physics forbids,
    none can: then one from the middle says by how much.

    Raises:
        InfeasibleError: none of those that were tried does.
    """
    tried = [families[part * len(families) // PROBES] for part in range(PROBES)]
    middle = tried[PROBES // 2]
    while tried:
        family = tried.pop(0)
        hard = [run for run in list_run_problems(route, requirements, family) if not run.elastic]
        if family == families[0] and any(_is_impossible(run) for run in hard):
            tried = [middle]
            continue
        try:
            list(solve_distinct(hard, solved=solved))
        except InfeasibleError:
            if not tried:
                raise
        else:
            return families[families.index(family) :]
    return families


def _is_impossible(run: RunProblem) -> bool:
    """Whether its legs have less time than physics needs for all of them."""
    open_times = tuple(replace(demand, duration=None) for demand in run.demands)
    given = sum(inf if demand.duration is None else demand.duration for demand in run.demands)
    return given < replace(run.run, demands=open_times).limit * (1 - SAME_DURATION)


def _solve_within(
    runs: Sequence[RunProblem], allowed: float, progress: Progress | None, solved: Solved
) -> tuple[list[Solution], float]:
    """Solutions of all distinct runs, none where these take more than `allowed` [s] above their limits.

    And what part of the limits of those that were solved that is.
    """
    count: dict[tuple[object, ...], int] = {}
    for run in runs:
        count[run.key()] = count.get(run.key(), 0) + 1
    distinct = {run.key(): run for run in runs}
    solutions: list[Solution] = []
    excess = known = 0.0

    def enough(run: RunProblem) -> float:
        return run.run.limit + (allowed - excess) / count[run.key()]

    for (key, run), solution in zip(
        distinct.items(), solve_distinct(runs, progress, enough, solved), strict=True
    ):
        solutions.append(solution)
        excess += count[key] * (solution.duration - run.run.limit)
        known += count[key] * run.run.limit
        if excess > allowed and not is_late():
            return [], excess / known if known else inf
    return solutions, 0.0
