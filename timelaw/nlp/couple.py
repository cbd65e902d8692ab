"""Programs that tie all runs together: given times, efforts, and the least used part of the limits."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from timelaw.easing import Timing, fraction
from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.program import Budget, Program, RunProblem, Solution, Status, total
from timelaw.problem.goal import Goal
from timelaw.route import Route
from timelaw.schedule import Schedule

AT_MINIMUM = 1e-5  # relative; so close to the least time there is no room but for the least-time law


@dataclass(frozen=True)
class Deadline:
    """A budget with the name of what asks for it, as a fault names it."""

    budget: Budget
    where: str
    what: str
    dwells: float


def deadlines(route: Route, schedule: Schedule, goal: Goal, least: float) -> list[Deadline]:
    """Arrival times and the total time as times of legs alone, in the order of the route.

    `least` is the least total time, dwells included.
    """
    found = []
    for node, time in sorted(schedule.arrivals.items()):
        waited, label = sum(schedule.dwells[:node]), route.nodes[node].label
        where, what = f"nodes.at.{label}.time", f"arrival at {label}"
        found.append(Deadline(Budget(node, time - waited), where, what, waited))
    if goal.total_time is not None:
        time = goal.total_time.seconds(least)
        budget = Budget(len(route.legs), time - schedule.dwell_time)
        found.append(Deadline(budget, "objective.total_time", "the end", schedule.dwell_time))
    return found


def couple(
    runs: Sequence[RunProblem], least: Sequence[Timing], goal: Goal, given: Sequence[Deadline]
) -> Solution:
    """Solve all runs as one program, from the least-time law stretched to the given times.

    Raises:
        InfeasibleError: a time cannot be met; says the earliest, or by how much limits would have to give.
    """
    from timelaw.nlp.exchange import solve_from

    budgets = tuple(deadline.budget for deadline in given)
    program = Program(tuple(runs), goal.minimise, goal.weight, budgets)
    start = stretched_to(least, given)
    if len(budgets) == 1 and total(start) <= total(least) * (1 + AT_MINIMUM):
        return Solution(start, Status.OPTIMAL)
    solution = solve_from(program, start)
    if solution is not None and _holds(program, solution):
        return _on_time(solution, budgets)
    peak = solve_from(replace(program, objective="peak", weight=None), start)
    if peak is None:
        raise InfeasibleError("the solver found no law in the given times; give more time or another degree")
    used = fraction(program.demands, peak.timings)
    if used > 1:
        message = f"within the given times the limits would have to be {used:.6g} times as large"
        raise InfeasibleError(Fault(message, given[-1].where if given else ""))
    solution = solve_from(program, peak.timings)
    if solution is not None and _holds(program, solution):
        return replace(_on_time(solution, budgets), status=Status.SECOND_START)
    return replace(_on_time(peak, budgets), status=Status.LEAST_PEAK)


def _holds(program: Program, solution: Solution) -> bool:
    """Whether the limits hold, proved; what makes the used part least may find it above 1."""
    used = fraction(program.demands, solution.timings)
    if program.objective == "peak" and used > 1 + AT_MINIMUM:
        message = f"within the given times the limits would have to be {used:.6g} times as large"
        raise InfeasibleError(Fault(message, "objective.total_time"))
    return used <= 1 or program.objective == "peak"


def stretched_to(least: Sequence[Timing], given: Sequence[Deadline]) -> tuple[Timing, ...]:
    """The least-time law, each part between two given times stretched by a factor of its own."""
    timings: list[Timing] = []
    passed = 0.0
    for deadline in given:
        part = least[len(timings) : deadline.budget.legs]
        left, needed = deadline.budget.time - passed, total(part)
        if left < needed * (1 - AT_MINIMUM / 10):
            earliest = passed + needed + deadline.dwells
            message = (
                f"{deadline.budget.time + deadline.dwells:.6g} s is too early for {deadline.what}: "
                f"the earliest possible is {earliest:.6g} s, {needed - left:.6g} s later"
            )
            raise InfeasibleError(Fault(message, deadline.where))
        timings += [timing.stretched(max(left / needed, 1.0)) for timing in part]
        passed = deadline.budget.time
    return (*timings, *least[len(timings) :])


def _on_time(solution: Solution, budgets: Sequence[Budget]) -> Solution:
    """Times met to the last digit, which the solver meets to its tolerance."""
    timings: list[Timing] = []
    passed = 0.0
    for budget in budgets:
        part = solution.timings[len(timings) : budget.legs]
        factor = (budget.time - passed) / total(part)
        timings += [timing.stretched(factor) for timing in part]
        passed = budget.time
    return replace(solution, timings=(*timings, *solution.timings[len(timings) :]))
