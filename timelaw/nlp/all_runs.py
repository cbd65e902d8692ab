"""Programs that tie all runs together: given times, efforts, and the least used part of the limits."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from math import inf

from timelaw.easing import Timing
from timelaw.easing.time_scaling import used_fraction
from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.program import LEAST_PEAK, Program, RunProblem
from timelaw.nlp.solution import Solution, Status, sum_durations
from timelaw.objectives import OBJECTIVES
from timelaw.problem.objective import Goal
from timelaw.requirements import Requirements
from timelaw.requirements.given_times import Budget, list_budgets, meet_budgets
from timelaw.route import Route

LEAST_FACTOR = 0.2  # of the least-time law; a start far beyond the limits helps nobody
AT_MINIMUM = 1e-5  # relative; so close to the least time there is no room but for the least-time law


@dataclass(frozen=True)
class Deadline:
    """A budget with the name of what asks for it, as a fault names it."""

    budget: Budget
    where: str
    what: str
    dwells: float


def list_deadlines(route: Route, requirements: Requirements, goal: Goal, least: float) -> list[Deadline]:
    """Arrival times and the total time as times of legs alone, in the order of the route.

    `least` is the least total time, dwells included.
    """
    found = []
    for budget in list_budgets(requirements):
        waited, label = sum(requirements.dwells[: budget.legs]), route.nodes[budget.legs].label
        where, what = f"nodes.at.{label}.time", f"arrival at {label}"
        found.append(Deadline(budget, where, what, waited))
    if goal.total_time is not None:
        time = goal.total_time.seconds(least)
        budget = Budget(len(route.legs), time - requirements.dwell_time)
        found.append(Deadline(budget, "objective.total_time", "the end", requirements.dwell_time))
    return found


def solve_together(
    runs: Sequence[RunProblem], least: Sequence[Timing], goal: Goal, given: Sequence[Deadline]
) -> Solution:
    """Solve all runs as one program, from the least-time law stretched to the given times.

    Raises:
        InfeasibleError: a time cannot be met; says the earliest, or by how much limits would have to give.
    """
    from timelaw.nlp.exchange import solve_from

    budgets = tuple(deadline.budget for deadline in given)
    program = Program(tuple(runs), OBJECTIVES[goal.minimise], goal.weight, budgets)
    start = stretch_to(runs, least, given)
    elastic = all(run.elastic for run in runs)
    whole = len(budgets) == 1 and budgets[0].legs == len(least)
    if elastic and whole and sum_durations(start) <= sum_durations(least) * (1 + AT_MINIMUM):
        return Solution(start, Status.OPTIMAL)
    scales, where = program.objective.scales_limits, given[-1].where if given else ""
    solution = solve_from(program, start)
    if solution is not None:
        used = used_fraction(program.demands, solution.timings)
        if used <= 1:
            return _on_time(runs, solution, budgets)
        if scales and elastic and used_fraction(program.demands, start) <= 1:
            return Solution(start, Status.STRETCHED)
        if scales:
            raise InfeasibleError(_beyond(used, where))
    peak = solve_from(replace(program, objective=LEAST_PEAK, weight=None), start)
    used = inf if peak is None else used_fraction(program.demands, peak.timings)
    if elastic and used > 1 and used_fraction(program.demands, start) <= 1:
        return Solution(start, Status.STRETCHED)
    if peak is None:
        raise InfeasibleError("the solver found no law in the given times; give more time or another degree")
    if used > 1:
        raise InfeasibleError(_beyond(used, where))
    solution = solve_from(program, peak.timings)
    if solution is not None and used_fraction(program.demands, solution.timings) <= 1:
        return replace(_on_time(runs, solution, budgets), status=Status.SECOND_START)
    return replace(_on_time(runs, peak, budgets), status=Status.LEAST_PEAK)


def _beyond(used: float, where: str) -> Fault:
    times = f"{used:.6g}" if used > 1 + AT_MINIMUM else f"{used:.9g}"
    return Fault(f"within the given times the limits would have to be {times} times as large", where)


def stretch_to(
    runs: Sequence[RunProblem], least: Sequence[Timing], given: Sequence[Deadline]
) -> tuple[Timing, ...]:
    """The least-time law, each part between two given times stretched by a factor of its own.

    Where a given time ends a run, the least-time law is there at the earliest. Inside a run a law may be
    earlier at a node than the one that is earliest at the end, so the solver has to say.
    """
    demands = [demand for run in runs for demand in run.demands]
    boundaries = set(accumulate(len(run.demands) for run in runs))
    timings: list[Timing] = []
    passed, since, waiting = 0.0, 0.0, 0.0
    for deadline in given:
        legs = slice(len(timings), deadline.budget.legs)
        left, needed = deadline.budget.time - passed, sum_durations(least[legs])
        fixed = all(demand.duration is not None for demand in demands[legs])
        if fixed and abs(left - needed) > AT_MINIMUM * needed:
            message = f"fixed durations put {deadline.what} at {passed + needed + deadline.dwells:.6g} s"
            raise InfeasibleError(Fault(message, deadline.where))
        waiting += needed
        if deadline.budget.legs in boundaries:
            if deadline.budget.time - since < waiting * (1 - AT_MINIMUM / 10):
                raise InfeasibleError(_too_early(deadline, since + waiting + deadline.dwells))
            since, waiting = deadline.budget.time, 0.0
        timings += [timing.stretched(max(left / needed, LEAST_FACTOR)) for timing in least[legs]]
        passed = deadline.budget.time
    return (*timings, *least[len(timings) :])


def _too_early(deadline: Deadline, earliest: float) -> Fault:
    asked = deadline.budget.time + deadline.dwells
    message = (
        f"{asked:.6g} s is too early for {deadline.what}: "
        f"the earliest possible is {earliest:.6g} s, {earliest - asked:.6g} s later"
    )
    return Fault(message, deadline.where)


def _on_time(runs: Sequence[RunProblem], solution: Solution, budgets: Sequence[Budget]) -> Solution:
    """Times met to the last digit, which the solver meets to its tolerance, by legs that may be stretched."""
    elastic = [run.elastic for run in runs for _ in run.demands]
    return replace(solution, timings=meet_budgets(solution.timings, elastic, budgets))
