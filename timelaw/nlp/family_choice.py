"""Of the families of easings that a problem allows the cheapest that comes near the physical limit."""

from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from math import inf

import numpy as np

from timelaw.easing.family import Family
from timelaw.errors import InfeasibleError
from timelaw.nlp.program import Program, RunProblem
from timelaw.nlp.single_runs import Solved, is_plain, solve_distinct, solve_runs
from timelaw.nlp.solution import Timings
from timelaw.objectives import OBJECTIVES
from timelaw.problem import Problem
from timelaw.progress import Progress
from timelaw.requirements import Requirements
from timelaw.route import Route
from timelaw.time_limit import is_late

SAME_DURATION = 1e-9
PROBES = 4  # of the families, cheapest first, that are tried where the cheapest cannot do what is given
LITTLE = 0.25  # of what is near enough, gained by a finer spline: the limit is not to be reached so
SAMPLE = 3  # runs by which families are judged before one of them solves all


def list_run_problems(route: Route, requirements: Requirements, family: Family) -> list[RunProblem]:
    """The runs of a route with what is demanded on them."""
    return [
        RunProblem(run.demands, family, run.start, run.end, run.where) for run in requirements.by_run(route)
    ]


def solve_least_within(
    problem: Problem, route: Route, requirements: Requirements, progress: Progress | None
) -> tuple[Family, Timings]:
    """The first family whose least time is near enough to the physical limit, or else the nearest.

    Families are judged by a few runs first, in the order of what they cost; then by all, from the one on that
    was near enough there. Where more than least time on the arcs is asked for, there is no limit to be near
    to: the first that can do it.

    Raises:
        InfeasibleError: the requirements cannot be met.
    """
    kind, easing = problem.easing.kind, problem.easing
    families = list(kind.families(easing, problem.nodes.continuity))
    solved: Solved = {}
    if len(families) > 1:
        families = able = _drop_infeasible(families, route, requirements, solved)
        for weigh in (_weigh_few, _weigh_all) if _is_least_time(problem, requirements) else ():
            search = _Search(route, requirements, weigh, kind.allowed_excess(easing), solved)
            family, near = search.find_near(families, progress)
            families = families[families.index(family) :]
            if not near:
                break
        if families[0] != able[0]:
            with suppress(InfeasibleError):  # a run that was not looked at may ask for the first that is able
                return _solve_all(families[0], route, requirements, progress, solved)
            families = able
    return _solve_all(families[0], route, requirements, progress, solved)


def _solve_all(
    family: Family, route: Route, requirements: Requirements, progress: Progress | None, solved: Solved
) -> tuple[Family, Timings]:
    """Least-time solutions of all runs by one family."""
    return family, solve_runs(list_run_problems(route, requirements, family), progress, solved)


def _is_least_time(problem: Problem, requirements: Requirements) -> bool:
    """Whether nothing is asked for but to be fast, on the arcs."""
    separable = OBJECTIVES[problem.objective.minimise].separable
    return separable and not requirements.arrivals and not problem.motion.through


def _weigh_all(runs: Sequence[RunProblem]) -> dict[RunProblem, float]:
    """The distinct runs, and how often each is made."""
    counts = Counter(run.key() for run in runs)
    return {run: float(counts[key]) for key, run in {run.key(): run for run in runs}.items()}


def _weigh_few(runs: Sequence[RunProblem]) -> dict[RunProblem, float]:
    """A few distinct runs, short and long ones, each of which stands for an equal part of the whole time."""
    ranked = sorted((run for run in runs if run.run.limit > 0), key=lambda run: run.run.limit)
    if not ranked:
        return _weigh_all(runs)
    passed = np.cumsum([run.run.limit for run in ranked])
    middles = (np.arange(SAMPLE) + 0.5) / SAMPLE * passed[-1]
    few = [ranked[index] for index in np.searchsorted(passed, middles).tolist()]
    return {run: count / run.run.limit for run, count in _weigh_all(few).items()}


def _is_dear(run: RunProblem) -> bool:
    """Whether another family comes nearer for less: a spline, where no polynomials are found together."""
    return Program((run,)).large or (run.family.polynomials is not None and not is_plain(run))


@dataclass(frozen=True)
class _Search:
    """For a family by some of the runs of a route, which `weigh` picks."""

    route: Route
    requirements: Requirements
    weigh: Callable[[Sequence[RunProblem]], dict[RunProblem, float]]
    within: float
    solved: Solved

    def find_near(self, families: Sequence[Family], progress: Progress | None) -> tuple[Family, bool]:
        """The first of the families that is near enough, or else the nearest; and whether it is near enough.

        Families that are dear are passed over, but for the first. The search ends where runs begin or end
        moving, or have times, at one that gains less than half of what is near enough: there the limit is one
        that need not be reached by any law; or where a finer spline hardly gains, as where torque moves the
        breaks. When the time is over, the family at hand is taken.
        """
        nearest, least_excess = families[0], inf
        for family in families:
            weights = self.weigh(list_run_problems(self.route, self.requirements, family))
            if family != families[0] and any(_is_dear(run) for run in weights):
                continue
            try:
                excess = self._measure_excess(weights, progress)
            except InfeasibleError:
                continue  # another one can do what is given, or the last word is said by what solves all
            if excess <= self.within or is_late():
                return family, True
            gained = least_excess - excess
            if 0 < gained < LITTLE * self.within and family.polynomials is None:
                break
            if gained > 0:
                nearest, least_excess = family, excess
            if gained < self.within / 2 and not all(run.elastic for run in weights):
                break
        return nearest, False

    def _measure_excess(self, weights: dict[RunProblem, float], progress: Progress | None) -> float:
        """What part of their limits the runs take beyond them.

        Of those that were solved, once these take more than all of them may: of the others none is solved.
        """
        allowed = self.within * sum(weight * run.run.limit for run, weight in weights.items())
        excess = known = 0.0

        def enough(run: RunProblem) -> float:
            return run.run.limit + (allowed - excess) / weights[run]

        for (run, weight), solution in zip(
            weights.items(), solve_distinct(list(weights), progress, enough, self.solved), strict=True
        ):
            excess += weight * (solution.duration - run.run.limit)
            known += weight * run.run.limit
            if excess > allowed and not is_late():
                break
        return excess / known if known else inf


def _drop_infeasible(
    families: list[Family], route: Route, requirements: Requirements, solved: Solved
) -> list[Family]:
    """The families from the first one on that can do what is given.

    A dearer one may hold limits that a cheaper one cannot, of which some are tried; what physics forbids,
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
