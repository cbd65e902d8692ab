"""The whole program in one function: from a problem file to a certified law beside its baselines."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from timelaw.certificate import Certificate, certify
from timelaw.certificate.geometry_check import RESOLVED
from timelaw.compose import compose_law
from timelaw.easing.family import Family
from timelaw.errors import Fault, InputError
from timelaw.motion import QuaternionLaw
from timelaw.motion.cycle import stretch_to_cycle
from timelaw.nlp import Timings, optimise
from timelaw.nlp.solution import sum_durations
from timelaw.numerics.threads import on_one_thread
from timelaw.orientations import OrientationSet, read_orientations
from timelaw.passing import pass_nodes
from timelaw.problem import Problem, Source, load_problem
from timelaw.problem.route import Orientations
from timelaw.progress import Progress, tell
from timelaw.requirements import Requirements, resolve_requirements
from timelaw.requirements.given_times import list_budgets
from timelaw.requirements.route_limit import find_route_limit
from timelaw.route import Route, lay_route
from timelaw.through.passage import Through
from timelaw.time_law import BASELINES, TimeLaw
from timelaw.time_law.time_law import OPTIMISED_LAW, STOPPING_LAW
from timelaw.tours import Tour, find_tour
from timelaw.tours.home import go_home

ROUTE_PARTS = ("route",)  # keys of a problem that its route depends on, besides whether nodes are passed
FASTEST_PARTS = ("limits", "body", "nodes", "segments")  # those that travel times depend on too


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

    @cached_property
    def limit(self) -> float:
        """A time [s] that no law on its arcs beats."""
        return find_route_limit(self.route, self.requirements)

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
    tell(progress, "proving the laws")
    time_law = TimeLaw(OPTIMISED_LAW, solution.timings, layout.requirements.dwells)
    optimised = certify_time_law(layout, time_law, problem.nodes.continuity)
    return _set_beside(layout, family, solution, end_on_cycle(problem, optimised))


def design_through(layout: Layout, progress: Progress | None = None) -> Design:
    """Design a law that passes the nodes without a stop, and where that is slower one that stops at corners.

    Raises:
        InfeasibleError: no law was found.
    """
    problem = layout.problem
    with layout.source.placed(), on_one_thread():
        found = pass_nodes(problem, layout.route, layout.requirements, progress)
    tell(progress, "proving the laws")
    stops = TimeLaw(STOPPING_LAW, found.solution.timings, layout.requirements.dwells)
    shown = found.family.rigid and "double-s" in problem.baselines  # as a baseline
    kept = replace(layout, requirements=found.kept)
    beside = [] if shown else [certify_time_law(kept, stops)]
    optimised = end_on_cycle(problem, Certified(OPTIMISED_LAW, found.law, found.certificate))
    return _set_beside(layout, found.family, found.solution, optimised, beside, found.through)


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


def end_on_cycle(problem: Problem, certified: Certified) -> Certified:
    """The law stretched to a multiple of the control cycle that is asked for, proved again."""
    if problem.output.grid is None:
        return certified
    law = stretch_to_cycle(certified.law, problem.output.grid)
    return replace(certified, law=law, certificate=certify(law))


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
        orientations = read_orientations(_take_orientations(problem), path.parent)
        tour = find_tour(problem, orientations, progress)
        if problem.route.home is not None:
            orientations, tour = go_home(orientations, tour, problem.route.home)
        route = lay_route(orientations, tour, merge=problem.motion.through)
        requirements = resolve_requirements(problem, route)
    return Layout(path, problem, source, orientations, tour, route, requirements)


def share_route(one: Problem, other: Problem) -> bool:
    """Whether two problems of one file lead to the same orientations, tour and route."""
    parts = ROUTE_PARTS if one.route.tour != "fastest" else ROUTE_PARTS + FASTEST_PARTS
    return one.motion.through == other.motion.through and all(
        getattr(one, part) == getattr(other, part) for part in parts
    )


def lay_out_again(layout: Layout, problem: Problem, source: Source) -> Layout:
    """The layout of a problem that shares the route of one that is laid out."""
    with source.placed(), on_one_thread():
        requirements = resolve_requirements(problem, layout.route)
    return replace(layout, problem=problem, source=source, requirements=requirements)


def _take_orientations(problem: Problem) -> Orientations:
    """What a tour goes through; curves have no tour.

    Raises:
        InputError: the route is one of curves.
    """
    if problem.route.orientations is None:
        raise InputError(Fault('a Bézier motion has no tour; use "timelaw design"', "route.bezier"))
    return problem.route.orientations


def certify_time_law(layout: Layout, time_law: TimeLaw, continuity: int = 0) -> Certified:
    """A time law laid along the route, and what is proved of it; `continuity` is what was asked of it."""
    law = compose_law(layout.problem.name, layout.route, time_law, layout.requirements, continuity)
    law = replace(law, shape=layout.problem.body.shape if layout.problem.body else None)
    return Certified(time_law.name, law, certify(law))
