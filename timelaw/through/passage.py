"""Passages: parts of a route between rests, each gone through without a stop, or with one at each corner."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from timelaw.easing import Timing
from timelaw.errors import Fault, InputError
from timelaw.limits.formula import Vector
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import conjugate, multiply
from timelaw.problem import Problem
from timelaw.progress import Progress
from timelaw.requirements import Requirements
from timelaw.route import Route
from timelaw.through.curve import Curve
from timelaw.through.ladder import Form, Rung, Stretch, climb
from timelaw.through.measures import LimitMeasure, list_limit_measures
from timelaw.time_limit import is_late

RICHEST = 9  # degree that is tried where the first one loses to stopping: mostly where speed is what limits


@dataclass(frozen=True)
class Passage:
    """Legs `first` to `last` (not included) of a route; without a `curve` they are run through as `stopping`.

    `stopping` [s] is how long that takes; `rungs` say what was tried.
    """

    first: int
    last: int
    stopping: float
    curve: Curve | None = None
    rungs: tuple[Rung, ...] = ()

    @property
    def legs(self) -> range:
        """Indices of its legs."""
        return range(self.first, self.last)

    @property
    def duration(self) -> float:
        """Of its motion [s]."""
        return self.stopping if self.curve is None else self.curve.total

    def take(self, curve: Curve | None) -> "Passage":
        """With that curve, if it is faster than stopping."""
        faster = curve is not None and curve.total < self.stopping
        return replace(self, curve=curve if faster else None)


@dataclass(frozen=True)
class Through:
    """All passages of a route, and whether the time limit ended the search.

    Where an effort or a peak is made least, `spent` is that of the law, `stopping_spent` that of the one that
    stops, if there is one.
    """

    passages: tuple[Passage, ...]
    stopped_early: bool = False
    spent: float | None = None
    stopping_spent: float | None = None

    @property
    def passed(self) -> int:
        """How many nodes are passed without a stop on curves."""
        return sum(len(passage.legs) - 1 for passage in self.passages if passage.curve is not None)


def find_passages(
    problem: Problem,
    route: Route,
    requirements: Requirements,
    timings: Sequence[Timing],
    progress: Progress | None = None,
) -> Through:
    """For each passage the fastest curve that was found, if it is faster than stopping as `timings` do."""
    form = read_form(problem)
    total = find_total_momentum(route, requirements)
    rests = sorted(k for k in requirements.stops if 0 < k < len(route.legs))
    round_ = problem.nodes.periodic
    cuts = [0, len(route.legs)] if round_ else [0, *rests, len(route.legs)]
    done = []
    for first, last in pairwise(cuts):
        passage = Passage(first, last, sum(timing.duration for timing in timings[first:last]))
        if last - first > 1 and not is_late():
            stretch = lay_stretch(route, timings, passage.legs)
            if round_:
                stretch = replace(stretch, rests=tuple(rests), periodic=True)
            measures = list_measures(route, requirements, passage.legs, total)

            def tell(rung: int, rungs: int, done: int = first) -> None:
                if progress is not None:
                    progress("passing the nodes", done * rungs + rung, len(route.legs) * rungs)

            curve, rungs = climb(stretch, measures, form, tell)
            passage = replace(passage, rungs=tuple(rungs)).take(curve)
            if passage.curve is None and form.searched and not is_late():
                curve, more = climb(stretch, measures, replace(form, degree=RICHEST), tell)
                passage = replace(passage, rungs=(*rungs, *more)).take(curve)
        done.append(passage)
    return Through(tuple(done), is_late())


def read_form(problem: Problem) -> Form:
    """The form of the curves that a problem asks for."""
    degree, pieces = problem.motion.chosen
    return Form(max(problem.nodes.continuity, 2), degree, pieces, problem.motion.deviation)


def lay_stretch(route: Route, timings: Sequence[Timing], legs: range) -> Stretch:
    """What the search needs of some legs that follow each other."""
    own = [route.legs[k] for k in legs]
    turn = np.vstack([own[0].start, *(leg.end for leg in own)])
    durations = np.array([timings[k].duration for k in legs])
    return Stretch(turn, route.angles[legs.start : legs.stop], durations)


def list_measures(route: Route, requirements: Requirements, legs: range, total: Vector) -> list[LimitMeasure]:
    """The limits on some legs; `total` is H in world axes."""
    own = [requirements.leg_limits.get(k, {}) for k in legs]
    found = list_limit_measures(requirements.limits, own, requirements.body, total)
    if not found:
        raise InputError(Fault(f"no limit bounds the motion of leg {route.legs[legs.start].name}", "limits"))
    return found


def find_total_momentum(route: Route, requirements: Requirements) -> list[float]:
    """H (3) in world axes: the body's at the start, turned by the first orientation."""
    body = requirements.body
    if body is None or not body.total_momentum:
        return [0.0, 0.0, 0.0]
    q = route.legs[0].start
    turned: Array = multiply(multiply(q, np.append(0.0, body.momentum)), conjugate(q))[1:]
    return [float(part) for part in turned]
