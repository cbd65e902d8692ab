"""What a problem gives besides its limits, for a motion through the nodes, and the curve that keeps it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf

import numpy as np

from timelaw.easing import Timing
from timelaw.easing.time_scaling import used_fraction
from timelaw.errors import Fault, InputError
from timelaw.numerics.array import Array
from timelaw.objectives import EFFORTS
from timelaw.objectives.effort import CALM
from timelaw.problem import Problem
from timelaw.requirements import Requirements
from timelaw.requirements.given_times import list_budgets
from timelaw.route import Route
from timelaw.through.curve import Curve
from timelaw.through.effort import measure_effort, measure_vector
from timelaw.through.given import CALM_PART, Given, climb_given
from timelaw.through.ladder import Form, Stretch, climb
from timelaw.through.measures import LimitMeasure, find_use
from timelaw.through.passage import (
    Passage,
    Through,
    find_total_momentum,
    lay_stretch,
    list_measures,
    read_form,
)
from timelaw.time_limit import is_late

EASED = 2e-10  # of the rates at an end, by which a motion keeps from a limit that it starts at
AT_LIMIT = 1e-6  # of a limit: what is typed as the limit itself may be rounded otherwise


@dataclass(frozen=True)
class GivenRoute:
    """A route as one stretch, its limits, and what is given; `least` is its least-time curve where needed."""

    stretch: Stretch
    measures: Sequence[LimitMeasure]
    form: Form
    given: Given
    least: Curve | None

    def spend(self, curve: Curve) -> float:
        """The effort of a curve, or the largest used part of a limit."""
        if self.given.peak:
            return max(find_use(curve, [m], plain=True).worst ** max(m.power, 1) for m in self.measures)
        return measure_effort(curve, self.given.vector)

    def weigh(self, time: float, spent: float) -> float:
        """What is made less; where time is, but all of it is given, the calmer law counts."""
        given = self.given
        if given.peak:
            return spent
        if given.scales is None:
            whole = any(legs == len(self.stretch.angles) for legs, _ in given.budgets)
            return spent if whole else time
        return given.time * time / given.scales[0] + given.effort * spent / given.scales[1]


def is_given(problem: Problem, requirements: Requirements) -> bool:
    """Whether anything is given that keeps time from being stretched."""
    moving = problem.nodes.moving_start is not None or problem.nodes.end is not None
    fixed = any(demand.duration is not None for demand in requirements.demands)
    return moving or fixed or bool(requirements.arrivals) or problem.objective.minimise != "time"


def resolve_given(
    problem: Problem,
    route: Route,
    requirements: Requirements,
    timings: Sequence[Timing],
    least: Curve | None = None,
) -> GivenRoute | None:
    """What is given, on the route; `timings` are of a law that stops, from which the search begins.

    `least` is the least-time curve if it is known. None where no curve keeps as near to the arcs as is asked.

    Raises:
        InputError: rates at an end break a limit.
    """
    form = read_form(problem)
    legs = range(len(route.legs))
    rests = tuple(k for k in sorted(requirements.stops) if 0 < k < len(route.legs))
    stretch = replace(lay_stretch(route, timings, legs), rests=rests, periodic=problem.nodes.periodic)
    measures = list_measures(route, requirements, legs, find_total_momentum(route, requirements))
    goal = problem.objective
    effort = goal.minimise if goal.minimise in EFFORTS else CALM.name
    body = requirements.body if EFFORTS[effort].needs_inertia else None
    given = Given(
        measure_vector(effort, len(route.legs), body),
        start=_find_rates(problem, route, measures, stretch, "start", form.smooth),
        end=_find_rates(problem, route, measures, stretch, "end", form.smooth),
        fixed={k: d.duration for k, d in enumerate(requirements.demands) if d.duration is not None},
        budgets=[(budget.legs, budget.time) for budget in list_budgets(requirements)],
        peak=goal.minimise == "peak",
    )
    if goal.minimise == "time":
        return GivenRoute(stretch, measures, form, replace(given, time=1.0, effort=CALM_PART), None)
    least = least or climb(stretch, measures, replace(form, pieces=1))[0]
    if least is None:
        return None
    given = replace(given, scales=(least.total, measure_effort(least, given.vector)))
    if goal.weight is not None:
        given = replace(given, time=1.0, effort=goal.weight)
    elif goal.total_time is not None:
        total = goal.total_time.seconds(least.total + requirements.dwell_time) - requirements.dwell_time
        given = replace(given, budgets=[*given.budgets, (len(route.legs), total)])
    return GivenRoute(stretch, measures, form, given, least)


def find_given_passage(
    route: GivenRoute, stopping: float, tell: Callable[[int, int], None], margin: float
) -> Passage:
    """The whole route on one curve, if one was found; `stopping` [s] is the time of a law that stops."""
    curve, rungs = climb_given(
        route.stretch, route.measures, route.form, route.given, _begin_from(route), margin, tell
    )
    return Passage(0, len(route.stretch.angles), stopping, curve, tuple(rungs))


def _begin_from(route: GivenRoute) -> Curve | None:
    """The least-time curve, stretched where a total time is all that is given; None where more is."""
    given, least = route.given, route.least
    if least is None or given.fixed or given.start is not None or given.end is not None:
        return None
    if not given.budgets:
        return least
    if len(given.budgets) > 1 or given.budgets[0][1] < least.total:
        return None
    return least.stretched(given.budgets[0][1] / least.total)


def _find_rates(
    problem: Problem, route: Route, measures: Sequence[LimitMeasure], stretch: Stretch, end: str, smooth: int
) -> Array | None:
    """Rates (r, 3) in body axes at an end that moves; numbers are about the leg there."""
    given = problem.nodes.moving_start if end == "start" else problem.nodes.end
    if given is None:
        return None
    axis = route.legs[0 if end == "start" else -1].axis
    rates = np.zeros((smooth, 3))
    for k, rate in enumerate(given.rates(problem.nodes.continuity)[:smooth]):
        rates[k] = np.array(rate) if isinstance(rate, tuple) else rate * axis
    q = stretch.turn[0 if end == "start" else -1]
    most = 0.0
    for measure in measures:
        used = measure.use_rates(q, rates, 0 if end == "start" else len(stretch.angles) - 1)
        if used > 1 + AT_LIMIT:
            message = f"{used:.6g} times as much as the limit on the {measure.limit.name} allows there"
            raise InputError(Fault(message, f"nodes.{end}"))
        most = max(most, used)
    return rates if most <= 1 - EASED else rates / (1 + EASED) ** np.arange(1, smooth + 1)[:, None]


def spend_stopping(problem: Problem, requirements: Requirements, timings: Sequence[Timing]) -> float | None:
    """The effort of a law on the arcs, or the part of its limits that it uses; None where time counts."""
    goal = problem.objective
    if goal.minimise == "peak":
        return used_fraction(requirements.demands, timings)
    return EFFORTS[goal.minimise].measure(requirements.demands, timings) if goal.minimise in EFFORTS else None


def decide(
    problem: Problem,
    requirements: Requirements,
    route: GivenRoute,
    passage: Passage,
    timings: Sequence[Timing] | None,
) -> Through:
    """The curve, or the law that stops where that is better or alone; `timings` None if there is none."""
    told = problem.objective.minimise != "time"
    mine = theirs = inf
    spent = stopping_spent = None
    if passage.curve is not None:
        spent = route.spend(passage.curve)
        mine = route.weigh(passage.curve.total, spent)
    if timings is not None:
        effort = spend_stopping(problem, requirements, timings)
        stopping_spent = CALM.measure(requirements.demands, timings) if effort is None else effort
        theirs = route.weigh(sum(timing.duration for timing in timings), stopping_spent)
    if mine >= theirs:
        passage, spent = replace(passage, curve=None), stopping_spent
    return Through((passage,), is_late(), spent if told else None, stopping_spent if told else None)


def describe_lack(passage: Passage) -> str:
    """Why there is no law, in a sentence."""
    tried = max((rung.pieces for rung in passage.rungs), default=1)
    return (
        "no law was found that keeps what is given, neither through the nodes (up to "
        f"{tried} piece{'s' if tried > 1 else ''} a leg) nor one that stops; give more time, or looser limits"
    )


def find_place(problem: Problem, requirements: Requirements, route: Route) -> str:
    """The key of what is given first: a time of arrival, a duration, rates at an end, the total time."""
    for node in sorted(requirements.arrivals):
        return f"nodes.at.{route.nodes[node].label}.time"
    for leg, demand in zip(route.legs, requirements.demands, strict=True):
        if demand.duration is not None:
            return f"segments.{leg.origin}-{leg.target}.duration"
    if problem.nodes.moving_start is not None:
        return "nodes.start"
    return "nodes.end" if problem.nodes.end is not None else "objective.total_time"
