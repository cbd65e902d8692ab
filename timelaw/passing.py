"""A law through the nodes: the law that stops, the search, the proof, and the better of the two."""

from dataclasses import dataclass

from timelaw.certificate import Certificate
from timelaw.easing.family import Family
from timelaw.errors import Fault, InfeasibleError
from timelaw.motion import QuaternionLaw
from timelaw.nlp import Timings, optimise
from timelaw.nlp.solution import Solution, Status, sum_durations
from timelaw.problem import Problem
from timelaw.problem.objective import TotalTime
from timelaw.progress import Progress
from timelaw.proved_passages import prove_given, prove_passages
from timelaw.requirements import Requirements
from timelaw.route import Route
from timelaw.through.curve import Curve
from timelaw.through.given_route import is_given, resolve_given
from timelaw.through.passage import Through, find_passages
from timelaw.through.stopping import list_stopping, relax
from timelaw.time_law.baselines import time_double_s


@dataclass(frozen=True)
class Passed:
    """The law that was found, and the one that stops: its family, its `solution`, and what it keeps."""

    family: Family
    solution: Timings
    kept: Requirements
    through: Through
    law: QuaternionLaw
    certificate: Certificate


def pass_nodes(
    problem: Problem, route: Route, requirements: Requirements, progress: Progress | None = None
) -> Passed:
    """The best law that was found.

    Raises:
        InfeasibleError: none was.
    """
    if is_given(problem, requirements):
        return _pass_given(problem, route, requirements, progress)
    family, solution = _stop(problem, route, requirements, progress)
    through = find_passages(problem, route, requirements, solution.timings, progress)
    proved = prove_passages(problem, route, requirements, through, solution.timings)
    return Passed(family, solution, requirements, *proved)


def _pass_given(
    problem: Problem, route: Route, requirements: Requirements, progress: Progress | None
) -> Passed:
    """The law that stops keeps what is given too, if one can."""
    ends = (problem.nodes.moving_start, problem.nodes.end)
    aslant = any(rates is not None and rates.in_body_axes for rates in ends)
    free, relaxed = relax(problem, requirements)
    kept, reason = requirements, None
    asked, least = _resolve_total_time(problem, route, requirements)
    try:
        if aslant:
            raise InfeasibleError(Fault("along an arc the body turns about its axis only"))
        family, solution = optimise(asked, route, requirements, progress)
    except InfeasibleError as error:  # what stops cannot; what passes the nodes may
        kept, reason = relaxed, error
        family, solution = _stop(free, route, relaxed, progress)
    given = resolve_given(asked, route, requirements, solution.timings, least)
    own = solution.timings if kept is requirements else None
    time = sum_durations(solution.timings)
    try:
        proved = prove_given(asked, route, requirements, given, own, time, progress)
    except InfeasibleError as error:
        raise InfeasibleError(*error.faults, *(reason.faults if reason else ())) from None
    return Passed(family, solution, kept, *proved)


def _stop(
    problem: Problem, route: Route, requirements: Requirements, progress: Progress | None = None
) -> tuple[Family, Timings]:
    """The fastest law that stops: where it may be the double-S, at corners or at every node."""
    asked = list_stopping(problem, requirements)
    found = [optimise(one, route, requirements, progress) for one in asked]
    family, _ = found[0]
    if family.rigid and "easing" not in problem.model_fields_set:
        every = time_double_s(route, requirements, stop=True).timings
        runs = len(requirements.runs(route))
        found.append((family, Timings(every, (Solution(every, Status.CHOSEN),), (0,) * runs)))
    return min(found, key=lambda one: sum_durations(one[1].timings))


def _resolve_total_time(
    problem: Problem, route: Route, requirements: Requirements
) -> tuple[Problem, Curve | None]:
    """The problem with its total time in seconds, and the least-time curve where it is a multiple of that."""
    total_time = problem.objective.total_time
    if total_time is None or not total_time.relative:
        return problem, None
    free, relaxed = relax(problem, requirements)
    _, stopping = _stop(free, route, relaxed)
    given = resolve_given(problem, route, requirements, stopping.timings)
    if given is None:
        return problem, None
    total = TotalTime(given.given.budgets[-1][1] + requirements.dwell_time)
    goal = problem.objective.model_copy(update={"total_time": total})
    return problem.model_copy(update={"objective": goal}), given.least
