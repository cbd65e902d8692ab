"""The whole program in one function: from a problem file to a certified law beside its baselines."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from timelaw.certificate import Certificate, certify
from timelaw.certificate.geometry_check import RESOLVED
from timelaw.compose import compose_law
from timelaw.easing.family import Family
from timelaw.errors import Fault, InfeasibleError, InputError
from timelaw.motion import QuaternionLaw
from timelaw.nlp import Timings, optimise
from timelaw.nlp.solution import sum_durations
from timelaw.numerics.threads import on_one_thread
from timelaw.orientations import OrientationSet, read_orientations
from timelaw.problem import Problem, Source, load_problem
from timelaw.problem.objective import TotalTime
from timelaw.progress import Progress
from timelaw.proved_passages import prove_given, prove_passages
from timelaw.requirements import Requirements, resolve_requirements
from timelaw.requirements.given_times import list_budgets
from timelaw.route import Route, lay_route
from timelaw.through.given_route import is_given, resolve_given
from timelaw.through.passage import Through, find_passages
from timelaw.through.stopping import list_stopping, relax
from timelaw.time_law import BASELINES, TimeLaw
from timelaw.time_law.time_law import OPTIMISED_LAW, STOPPING_LAW
from timelaw.tours import Tour, find_tour


@dataclass(frozen=True)
class Layout:
    """What is fixed before any time is chosen."""

    path: Path
    problem: Problem
    source: Source
    orientations: OrientationSet
    tour: Tour
    route: Route
    requirements: Requirements


@dataclass(frozen=True)
class Certified:
    """A law with its certificate."""

    name: str
    law: QuaternionLaw
    certificate: Certificate


@dataclass(frozen=True)
class Design(Layout):
    """All that came of a problem: everything the report shows and the files hold."""

    family: Family
    solution: Timings
    optimised: Certified
    baselines: tuple[Certified, ...]
    through: Through | None = None

    @property
    def stopped_early(self) -> bool:
        """Whether the time limit ended the search for the law."""
        return self.solution.stopped_early or (self.through is not None and self.through.stopped_early)

    @property
    def laws(self) -> tuple[Certified, ...]:
        """The optimised law, then the baselines."""
        return (self.optimised, *self.baselines)


def design(path: str | Path, progress: Progress | None = None) -> Design:
    """Read a problem file and design its law.

    Raises:
        InputError: the problem file, or a table it names, is wrong.
        InfeasibleError: no law was found.
    """
    problem, source = load_problem(path := Path(path))
    return design_problem(path, problem, source, progress)


def design_problem(path: Path, problem: Problem, source: Source, progress: Progress | None = None) -> Design:
    """Design the law of a problem that is already read; tables are looked for beside `path`."""
    return design_layout(lay_out_problem(path, problem, source, progress), progress)


def design_layout(layout: Layout, progress: Progress | None = None) -> Design:
    """Design the law of a problem whose route is laid.

    Raises:
        InfeasibleError: no law was found.
    """
    problem = layout.problem
    if problem.motion.through:
        return design_through(layout, progress)
    with layout.source.placed(), on_one_thread():
        family, solution = optimise(problem, layout.route, layout.requirements, progress)
    time_law = TimeLaw(OPTIMISED_LAW, solution.timings, layout.requirements.dwells)
    optimised = certify_time_law(layout, time_law, problem.nodes.continuity)
    return _set_beside(layout, family, solution, optimised)


def design_through(layout: Layout, progress: Progress | None = None) -> Design:
    """Design a law that passes the nodes without a stop, and where that is slower one that stops at corners.

    Raises:
        InfeasibleError: no law was found.
    """
    problem, route, requirements = layout.problem, layout.route, layout.requirements
    with layout.source.placed(), on_one_thread():
        if is_given(problem, requirements):
            family, solution, kept, proved = _design_given(layout, progress)
        else:
            kept = requirements
            family, solution = _stop(problem, route, requirements, progress)
            through = find_passages(problem, route, requirements, solution.timings, progress)
            proved = prove_passages(problem, route, requirements, through, solution.timings)
    through, law, certificate = proved
    stops = TimeLaw(STOPPING_LAW, solution.timings, requirements.dwells)
    shown = family.rigid and "double-s" in problem.baselines  # as a baseline
    beside = [] if shown else [certify_time_law(replace(layout, requirements=kept), stops)]
    optimised = Certified(OPTIMISED_LAW, law, certificate)
    return _set_beside(layout, family, solution, optimised, beside, through)


def _design_given(
    layout: Layout, progress: Progress | None
) -> tuple[Family, Timings, Requirements, tuple[Through, QuaternionLaw, Certificate]]:
    """The law that stops, which keeps what is given if one does, and the law that passes the nodes."""
    problem, route, requirements = layout.problem, layout.route, layout.requirements
    ends = (problem.nodes.moving_start, problem.nodes.end)
    aslant = any(rates is not None and rates.in_body_axes for rates in ends)
    free, relaxed = relax(problem, requirements)
    kept, goal = requirements, problem.objective
    asked = problem
    try:
        if aslant:
            raise InfeasibleError(Fault("along an arc the body turns about its axis only"))
        if goal.total_time is not None and goal.total_time.relative:
            asked = _resolve_total_time(layout, free, relaxed)
        family, solution = optimise(asked, route, requirements, progress)
    except InfeasibleError:  # what stops cannot; what passes the nodes may
        kept = relaxed
        family, solution = _stop(free, route, relaxed, progress)
    given = resolve_given(asked, route, requirements, solution.timings)
    own = solution.timings if kept is requirements else None
    time = sum_durations(solution.timings)
    proved = prove_given(asked, route, requirements, given, own, time, progress)
    return family, solution, kept, proved


def _stop(
    problem: Problem, route: Route, requirements: Requirements, progress: Progress | None = None
) -> tuple[Family, Timings]:
    """The fastest law that stops."""
    found = [optimise(asked, route, requirements, progress) for asked in list_stopping(problem, requirements)]
    return min(found, key=lambda one: sum_durations(one[1].timings))


def _resolve_total_time(layout: Layout, free: Problem, relaxed: Requirements) -> Problem:
    """The problem with the total time in seconds that it gives as a multiple of the least one."""
    _, least = _stop(free, layout.route, relaxed)
    given = resolve_given(layout.problem, layout.route, layout.requirements, least.timings)
    legs = given.given.budgets[-1][1]
    total = TotalTime(legs + layout.requirements.dwell_time)
    goal = layout.problem.objective.model_copy(update={"total_time": total})
    return layout.problem.model_copy(update={"objective": goal})


def _set_beside(
    layout: Layout,
    family: Family,
    solution: Timings,
    optimised: Certified,
    beside: Sequence[Certified] = (),
    through: Through | None = None,
) -> Design:
    """The design of a law with the baselines, and what else stands `beside` it."""
    problem = layout.problem
    with layout.source.placed():
        _refuse_unresolved(optimised)
    given = problem.objective.total_time is not None
    moving = sum_durations(solution.timings)
    if through is not None:
        moving = optimised.law.duration - layout.requirements.dwell_time
    budgets = list_budgets(layout.requirements, moving if given else None)
    baselines = [
        certify_time_law(layout, baseline)
        for name in problem.baselines
        for baseline in BASELINES[name](layout.route, layout.requirements, budgets)
    ]
    return Design(
        **vars(layout),
        family=family,
        solution=solution,
        optimised=optimised,
        baselines=(*beside, *baselines),
        through=through,
    )


def _refuse_unresolved(optimised: Certified) -> None:
    """Refuse a motion so long that doubles do not tell the instants of a segment apart.

    Raises:
        InputError: with that segment.
    """
    for check in optimised.certificate.geometry:
        if check.check == RESOLVED and not check.holds:
            message = (
                f"{optimised.law.duration:.6g} s are too long a motion for the instants of {check.where}: "
                f"numbers of double precision are {check.worst:.1g} of it apart there, and "
                f"{check.tolerance:.0g} is needed; shorten the dwells, or make two motions of it"
            )
            raise InputError(Fault(message, "nodes"))


def lay_out(path: str | Path, progress: Progress | None = None) -> Layout:
    """Read a problem file as far as its route and what is required on it, without designing a law.

    Raises:
        InputError: the problem file, or a table it names, is wrong.
    """
    problem, source = load_problem(path := Path(path))
    return lay_out_problem(path, problem, source, progress)


def lay_out_problem(path: Path, problem: Problem, source: Source, progress: Progress | None = None) -> Layout:
    """The orientations, the tour through them, the route it fixes, and what is required on that."""
    with source.placed(), on_one_thread():
        orientations = read_orientations(problem.route.orientations, path.parent)
        tour = find_tour(problem, orientations, progress)
        route = lay_route(orientations, tour, merge=problem.motion.through)
        requirements = resolve_requirements(problem, route)
    return Layout(path, problem, source, orientations, tour, route, requirements)


def certify_time_law(layout: Layout, time_law: TimeLaw, continuity: int = 0) -> Certified:
    """A time law laid along the route, and what is proved of it; `continuity` is what was asked of it."""
    law = compose_law(layout.problem.name, layout.route, time_law, layout.requirements, continuity)
    return Certified(time_law.name, law, certify(law))
