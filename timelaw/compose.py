"""Where the two wings meet: a time law laid along its route becomes the motion."""

from collections.abc import Sequence

import numpy as np

from timelaw.easing import Timing
from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.arc import Arc
from timelaw.motion.deviation import DEVIATION
from timelaw.motion.dwell import Dwell
from timelaw.motion.quaternion_curve import QuaternionCurve
from timelaw.motion.rational import Rational
from timelaw.motion.segment import MAX_ORDER
from timelaw.numerics.array import Array
from timelaw.requirements import Requirements
from timelaw.route import Route
from timelaw.through.curve import Curve
from timelaw.through.passage import Passage
from timelaw.time_law import TimeLaw


def compose_through(
    name: str,
    route: Route,
    passages: Sequence[Passage],
    timings: Sequence[Timing],
    requirements: Requirements,
    continuity: int,
    deviation: float | None = None,
    *,
    periodic: bool = False,
) -> QuaternionLaw:
    """Lay curves where passages have them, and where not the `timings` of all legs, along a route.

    One that is `periodic` goes round where it ends as it began.
    """
    segments: list[Segment] = []
    time = 0.0
    visits = [route.legs[0].start, *(leg.end for leg in route.legs)]
    curves = {k: (passage.curve, k - passage.first) for passage in passages for k in passage.legs}
    bound = {} if deviation is None else {DEVIATION: deviation}
    for index, dwell in enumerate(requirements.dwells):
        if dwell > 0:
            segments.append(Dwell(route.nodes[index].label, time, dwell, visits[index]))
            time += dwell
        if index == len(route.legs):
            break
        leg, (curve, number), limits = (
            route.legs[index],
            curves[index],
            requirements.leg_limits.get(index, {}),
        )
        ends = (leg.origin, leg.target, time)
        if curve is None:
            duration = timings[index].duration
            profile = timings[index].profile(leg.angle)
            segments.append(Arc(*ends, duration, leg.start, leg.end, leg.axis, leg.angle, profile, limits))
        else:
            pieces = _cut_curve(curve, number)
            duration = pieces[0].duration * curve.pieces
            segments.append(Rational(*ends, duration, leg.start, leg.end, pieces, {**limits, **bound}))
        time += duration
    before, after = (_list_rates(passages[end].curve, end) for end in (0, -1))
    moving = any(np.any(rate) for rates in (before, after) for rate in rates.values())
    goes_round = periodic and moving
    outside = (before, after) if moving and not periodic else ({}, {})
    own = (requirements.limits, requirements.body, continuity)
    return QuaternionLaw(name, tuple(segments), *own, *outside, goes_round, requirements.shape)


def _list_rates(curve: Curve | None, end: int) -> dict[int, Array]:
    """The rates (3,) of its first (0) or last (-1) knot by order; of rest without a curve."""
    known = {} if curve is None else dict(enumerate(curve.rates[end], 1))
    return {k: known.get(k, np.zeros(3)) for k in range(1, MAX_ORDER + 1)}


def _cut_curve(curve: Curve, leg: int) -> tuple[QuaternionCurve, ...]:
    """The pieces of one of its legs."""
    own = slice(leg * curve.pieces, (leg + 1) * curve.pieces)
    return tuple(QuaternionCurve(float(curve.duration[leg]), points) for points in curve.control()[own])


def compose_law(
    name: str, route: Route, time_law: TimeLaw, requirements: Requirements, continuity: int = 0
) -> QuaternionLaw:
    """Lay a time law along its route; `continuity` is what was asked of it."""
    segments: list[Segment] = []
    visits = [*(leg.start for leg in route.legs), route.legs[-1].end]
    for kind, index, start, duration in time_law.intervals():
        if kind == "dwell":
            segments.append(Dwell(route.nodes[index].label, start, duration, visits[index]))
            continue
        leg, timing = route.legs[index], time_law.timings[index]
        ends = (leg.origin, leg.target, start, duration, leg.start, leg.end, leg.axis, leg.angle)
        segments.append(Arc(*ends, timing.profile(leg.angle), requirements.leg_limits.get(index, {})))
    moving = any(requirements.start) or any(requirements.end)
    before, after = (
        {k: rate * leg.axis for k, rate in enumerate([*rates, *[0.0] * MAX_ORDER][:MAX_ORDER], 1)}
        if moving
        else {}
        for rates, leg in ((requirements.start, route.legs[0]), (requirements.end, route.legs[-1]))
    )
    own = (requirements.limits, requirements.body, continuity, before, after)
    return QuaternionLaw(name, tuple(segments), *own, shape=requirements.shape)
