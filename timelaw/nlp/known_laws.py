"""Laws over a run that need no solver of the whole run: a steady turn, a stop at every node."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import factorial

import numpy as np

from timelaw.easing import Profile, Timing
from timelaw.easing.double_s_easing import spread_double_s
from timelaw.easing.family import Family
from timelaw.easing.profile import Piece
from timelaw.easing.time_scaling import used_fraction
from timelaw.limits import Demand
from timelaw.nlp.elastic_runs import SAME_TIME, solve_elastic
from timelaw.nlp.program import RunProblem
from timelaw.nlp.solution import Solution, Status
from timelaw.requirements.given_times import find_stretch

SAME_RATE = 1e-9  # relative: a run entered and left at one speed but for the last digits


def list_known(problem: RunProblem) -> Iterator[Solution]:
    """Laws that hold the limits and need no solver of the whole run: a steady turn; a stop at every node."""
    demands = problem.demands
    if problem.run.moving:
        steady = _turn_steadily(problem)
        if steady and used_fraction(demands, steady) <= 1:
            yield Solution(steady, Status.STEADY)
        return
    timings = stop_in_time(problem)
    if used_fraction(demands, timings) <= 1:
        yield Solution(timings, Status.STOPS if len(demands) > 1 else Status.AT_MINIMUM)


def stop_in_time(problem: RunProblem) -> tuple[Timing, ...]:
    """The law that stops at every node, in the durations that are fixed."""
    return stop_at_nodes(problem.demands, [problem.family] * len(problem.demands))


def stop_at_nodes(demands: Sequence[Demand], families: Sequence[Family]) -> tuple[Timing, ...]:
    """Every leg from rest to rest in its least time, or in its own where that is fixed."""
    known: dict[object, Timing] = {}
    timings = []
    for demand, family in zip(demands, families, strict=True):
        if demand.key() not in known:
            leg = RunProblem((replace(demand, duration=None),), family)
            (timing,) = solve_elastic(leg).timings
            known[demand.key()] = timing if demand.duration is None else _spread(demand, family, timing)
        timings.append(known[demand.key()])
    return tuple(timings)


def _spread(demand: Demand, family: Family, least: Timing) -> Timing:
    """A leg's law of least time in the duration that it has, or what uses less of its limits in that time."""
    assert demand.duration is not None
    stretched = least.stretched(find_stretch(demand.duration, least.duration))
    if not family.has_profile((demand,)):
        return stretched
    profile = spread_double_s(demand, demand.duration)
    return min(stretched, profile, key=lambda timing: used_fraction([demand], [timing]))


def _turn_steadily(problem: RunProblem) -> tuple[Timing, ...]:
    """At the speed of the start until the last leg, to that of the end on it; empty if they are not near."""
    start, end = problem.run.speeds
    others = (*problem.start[1:], *problem.end[1:])
    given = any(demand.duration is not None for demand in problem.demands)
    if given or any(others) or not start or abs(start - end) > SAME_RATE * start:
        return ()
    order, last = problem.family.continuity, len(problem.demands) - 1
    return tuple(
        _change_speed(demand.angle, start, end if index == last else start, order)
        for index, demand in enumerate(problem.demands)
    )


def _change_speed(angle: float, start: float, end: float, order: int) -> Timing:
    """φ' = start + (end - start) S, S the smoothstep on whose ends `order` - 1 derivatives vanish.

    The change keeps every jump away that two ends with different last digits would make.
    """
    duration = 2 * angle / (start + end)
    rise = np.repeat([0.0, 1.0], order)  # control points of S
    highest = np.diff(rise, order) * (factorial(2 * order - 1) // factorial(order - 1))
    state = np.array([0.0, start * duration / angle, *[0.0] * (order - 1)])
    piece = Piece(1.0, state, (end - start) * duration / angle * highest)
    return Timing(duration, Profile((piece,)))


def is_least(problem: RunProblem, solution: Solution) -> bool:
    """As fast as physics allows."""
    return solution.duration <= problem.run.limit * (1 + SAME_TIME)
