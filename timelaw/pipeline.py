"""The whole program in one function: from a problem file to a certified law beside its baselines."""

from dataclasses import dataclass
from pathlib import Path

from timelaw.certificate import Certificate, certify
from timelaw.compose import compose_law
from timelaw.easing.family import Family
from timelaw.motion import QuaternionLaw
from timelaw.nlp import Optimised, optimise
from timelaw.nlp.easing_choice import allowed_excess, choose_families
from timelaw.orientations import OrientationSet, orientations
from timelaw.problem import Problem, Source, load
from timelaw.progress import Progress
from timelaw.route import Route, route
from timelaw.schedule import Schedule, schedule
from timelaw.time_law import BASELINES, TimeLaw, optimised
from timelaw.tours import Tour, tour


@dataclass(frozen=True)
class Certified:
    """A law with its certificate."""

    name: str
    law: QuaternionLaw
    certificate: Certificate


@dataclass(frozen=True)
class Design:
    """All that came of a problem: everything the report shows and the files hold."""

    path: Path
    problem: Problem
    source: Source
    orientations: OrientationSet
    tour: Tour
    route: Route
    schedule: Schedule
    family: Family
    solution: Optimised
    optimised: Certified
    baselines: tuple[Certified, ...]

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
    problem, source = load(path := Path(path))
    return design_problem(path, problem, source, progress)


def design_problem(path: Path, problem: Problem, source: Source, progress: Progress | None = None) -> Design:
    """Design the law of a problem that is already read; tables are looked for beside `path`."""
    with source.placed():
        points, order, way, plan = _lay_out(path, problem, progress)
        candidates = choose_families(problem)
        family, solution = optimise(
            way, plan, candidates, allowed_excess(problem), problem.objective, progress
        )
    law = _certified(problem, way, optimised(solution, plan), plan, problem.nodes.continuity)
    baselines = [b for name in problem.baselines for b in BASELINES[name](way, plan)]
    beside = tuple(_certified(problem, way, time_law, plan) for time_law in baselines)
    return Design(path, problem, source, points, order, way, plan, family, solution, law, beside)


@dataclass(frozen=True)
class Layout:
    """What is fixed before any time is chosen."""

    path: Path
    problem: Problem
    orientations: OrientationSet
    tour: Tour
    route: Route
    schedule: Schedule


def lay_out(path: str | Path, progress: Progress | None = None) -> Layout:
    """Read a problem file as far as its route and what is demanded on it, without designing a law.

    Raises:
        InputError: the problem file, or a table it names, is wrong.
    """
    problem, source = load(path := Path(path))
    with source.placed():
        return Layout(path, problem, *_lay_out(path, problem, progress))


def _lay_out(
    path: Path, problem: Problem, progress: Progress | None
) -> tuple[OrientationSet, Tour, Route, Schedule]:
    points = orientations(problem.route.orientations, path.parent)
    order = tour(problem, points, progress)
    way = route(points, order)
    return points, order, way, schedule(problem, way)


def _certified(
    problem: Problem, way: Route, time_law: TimeLaw, plan: Schedule, continuity: int = 0
) -> Certified:
    law = compose_law(problem.name, way, time_law, plan, continuity)
    return Certified(time_law.name, law, certify(law))
