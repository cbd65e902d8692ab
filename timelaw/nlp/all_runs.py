"""Programs that tie all runs together: given times, efforts, and the least used part of the limits."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from math import inf

from timelaw.easing import Timing
from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.given_runs import (
    SHOWN,
    TIME_OVER,
    solve_from_peak,
)
from timelaw.nlp.known_laws import stop_at_nodes
from timelaw.nlp.least_peaks import find_least_peak, holds_limits
from timelaw.nlp.program import Program, RunProblem
from timelaw.nlp.solution import Solution, Status, sum_durations
from timelaw.nlp.verdicts import Verdict
from timelaw.objectives import OBJECTIVES
from timelaw.problem.objective import Goal
from timelaw.requirements import Requirements
from timelaw.requirements.given_times import LAST_DIGIT, Budget, find_stretch, list_budgets, meet_budgets
from timelaw.route import Route
from timelaw.time_limit import is_late

SAME_START = 1e-9  # relative, of a duration: from there the solver goes the same way
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
    room = sum_durations(start) / sum_durations(least) - 1
    if whole and room <= (AT_MINIMUM if elastic else LAST_DIGIT):
        return Solution(start if elastic else tuple(least), Status.AT_MINIMUM)
    by_runs = {sum(len(run.demands) for run in runs[:count]) for count in range(len(runs) + 1)}
    apart = all(
        budget.legs in by_runs for budget in budgets
    )  # parts of one run, stretched apart, do not join
    starts = [Solution(start, Status.STRETCHED)] if elastic and apart else []
    failures: list[Verdict] = []
    solution = _put_on_time(program, solve_from(program, start, failures))
    if solution is None:
        stops = _stop_everywhere(program)
        others = [stop.timings for stop in stops if not _same(stop.timings, start)]
        solution = _solve_from_any(program, others)
        starts += stops
    if solution is not None:
        return solution
    feasible = [on_time for known in starts if (on_time := _put_on_time(program, known)) is not None]
    if feasible:
        known = replace(feasible[0], status=Status.STOPPED) if is_late() else feasible[0]
        return replace(known, failures=tuple(failures))
    if is_late():
        raise InfeasibleError(Fault(TIME_OVER, given[-1].where if given else ""))
    where = _find_hardest(program, start, given)
    return _meet_times(program, solve_from_peak(program, [start], where))


def solve_weighed(runs: Sequence[RunProblem], least: Sequence[Timing], goal: Goal) -> list[Solution]:
    """Solutions of the distinct runs for T/T* + w E/E*, which is a sum over the runs.

    Of a run by itself, whose least-time law takes T*ᵢ and Eᵢ*, the weight is w (Eᵢ*/E*)(T*/T*ᵢ).
    """
    effort = OBJECTIVES[goal.minimise]
    demands = [demand for run in runs for demand in run.demands]
    time, size = sum_durations(least), effort.scale(demands, least) or 1.0
    solutions: dict[tuple[object, ...], Solution] = {}
    passed = 0
    for run in runs:
        own = least[passed : passed + len(run.demands)]
        passed += len(own)
        if run.key() not in solutions:
            share = (effort.scale(run.demands, own) or 1.0) / size * time / sum_durations(own)
            weighed = goal.model_copy(update={"weight": (goal.weight or 0.0) * share})
            solutions[run.key()] = solve_together([run], own, weighed, [])
    return list(solutions.values())


def _same(some: Sequence[Timing], others: Sequence[Timing]) -> bool:
    """Whether two starts are one."""
    return all(
        abs(a.duration - b.duration) < SAME_START * b.duration and a.easing.key() == b.easing.key()
        for a, b in zip(some, others, strict=True)
    )


def _solve_from_any(program: Program, starts: Sequence[Sequence[Timing]]) -> Solution | None:
    """The first solution that holds the limits."""
    from timelaw.nlp.exchange import solve_from

    for start in starts:
        solution = _put_on_time(program, solve_from(program, start))
        if solution is not None:
            return replace(solution, status=Status.SECOND_START)
    return None


def _stop_everywhere(program: Program) -> list[Solution]:
    """The law that stops at every node, in the given times, where these are not too short for it."""
    if any(run.run.moving for run in program.runs):
        return []
    families = [run.family for run in program.runs for _ in run.demands]
    least = stop_at_nodes(program.demands, families)
    elastic = [demand.duration is None for demand in program.demands]
    return [Solution(meet_budgets(least, elastic, program.budgets), Status.STOPS)]


def _find_hardest(program: Program, start: Sequence[Timing], given: Sequence[Deadline]) -> str:
    """The key of the first given time that cannot be kept together with those before it."""
    for count, deadline in enumerate(given[:-1], 1):
        budgets = tuple(known.budget for known in given[:count])
        part = replace(program, budgets=budgets, beyond=inf)
        peak = find_least_peak(part, [start], enough=1 + SHOWN)
        if peak is None or not holds_limits(part, peak):
            return deadline.where
    return given[-1].where if given else ""


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
            if deadline.budget.time - since < waiting * (1 - LAST_DIGIT):
                begun = (*timings, *least[legs])
                earliest = _find_earliest(runs, begun, [known.budget for known in given])
                least_known = (earliest or since + waiting) + deadline.dwells
                raise InfeasibleError(_too_early(deadline, least_known, sure=earliest is not None))
            since, waiting = deadline.budget.time, 0.0
        factor = max(find_stretch(left, needed), LEAST_FACTOR)
        timings += [timing.stretched(factor) for timing in least[legs]]
        passed = deadline.budget.time
    return (*timings, *least[len(timings) :])


def _find_earliest(
    runs: Sequence[RunProblem], begun: Sequence[Timing], budgets: Sequence[Budget]
) -> float | None:
    """How soon the legs begun can be done if the times given before are kept; None where the solver fails.

    A time that is given inside a run keeps it from being as early at its end as it could.
    """
    from timelaw.nlp.exchange import solve_from

    ends = list(accumulate(len(run.demands) for run in runs))
    part = tuple(runs[: ends.index(len(begun)) + 1])
    program = Program(part, budgets=tuple(budget for budget in budgets if budget.legs < len(begun)))
    found = solve_from(program, begun)
    return found.duration if found is not None and holds_limits(program, found) else None


def _too_early(deadline: Deadline, earliest: float, *, sure: bool) -> Fault:
    """What is said of a time before the earliest; not `sure`, that is later than the time here."""
    asked = deadline.budget.time + deadline.dwells
    digits = 6 if earliest > asked * (1 + SHOWN) else 12
    if is_late():  # how early is not known
        message = (
            f"the time limit ended the search: the earliest found for {deadline.what} by then is "
            f"{earliest:.{digits}g} s, {asked:.{digits}g} s is asked for; give more with --time-limit"
        )
        return Fault(message, deadline.where)
    message = (
        f"{asked:.{digits}g} s is too early for {deadline.what}: the earliest possible is "
        f"{'' if sure else 'not before '}{earliest:.{digits}g} s, {earliest - asked:.6g} s later"
    )
    return Fault(message, deadline.where)


def _meet_times(program: Program, solution: Solution) -> Solution:
    """Times met to the last digit, which the solver meets to its tolerance, by legs that may be stretched."""
    elastic = [run.elastic for run in program.runs for _ in run.demands]
    return replace(solution, timings=meet_budgets(solution.timings, elastic, program.budgets))


def _put_on_time(program: Program, solution: Solution | None) -> Solution | None:
    """The same on time; None where it then breaks a limit."""
    if solution is None:
        return None
    found = _meet_times(program, solution)
    return found if holds_limits(program, found) else None
