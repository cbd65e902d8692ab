"""Where the two wings meet: a time law laid along its route becomes the motion."""

from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.arc import Arc
from timelaw.motion.dwell import Dwell
from timelaw.motion.segment import MAX_ORDER
from timelaw.requirements import Requirements
from timelaw.route import Route
from timelaw.time_law import TimeLaw


def compose_law(
    name: str, route: Route, time_law: TimeLaw, requirements: Requirements, continuity: int = 0
) -> QuaternionLaw:
    """Lay a time law along its route; `continuity` is what was asked of it."""
    segments: list[Segment] = []
    for kind, index, start, duration in time_law.intervals():
        if kind == "dwell":
            visits = [*(leg.start for leg in route.legs), route.legs[-1].end]
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
    return QuaternionLaw(
        name, tuple(segments), requirements.limits, requirements.body, continuity, before, after
    )
