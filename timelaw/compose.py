"""Where the two wings meet: a time law laid along its route becomes the motion."""

from timelaw.motion.arc import Arc
from timelaw.motion.dwell import Dwell
from timelaw.motion.quaternion_law import QuaternionLaw
from timelaw.motion.segment import MAX_ORDER, Segment
from timelaw.route import Route
from timelaw.schedule import Schedule
from timelaw.time_law import TimeLaw


def compose_law(
    name: str, route: Route, time_law: TimeLaw, schedule: Schedule, continuity: int = 0
) -> QuaternionLaw:
    """Lay a time law along its route; `continuity` is what was asked of it."""
    segments: list[Segment] = []
    for kind, index, start, duration in time_law.intervals():
        if kind == "dwell":
            visits = [*(leg.start for leg in route.legs), route.legs[-1].end]
            segments.append(Dwell(route.nodes[index].label, start, duration, visits[index]))
            continue
        leg, easing = route.legs[index], time_law.timings[index].easing
        ends = (leg.origin, leg.target, start, duration, leg.start, leg.end, leg.axis, leg.angle)
        segments.append(Arc(*ends, easing, schedule.leg_limits.get(index, {})))
    moving = any(schedule.start) or any(schedule.end)
    before, after = (
        {k: rate * leg.axis for k, rate in enumerate([*rates, *[0.0] * MAX_ORDER][:MAX_ORDER], 1)}
        if moving
        else {}
        for rates, leg in ((schedule.start, route.legs[0]), (schedule.end, route.legs[-1]))
    )
    return QuaternionLaw(name, tuple(segments), schedule.limits, schedule.inertia, continuity, before, after)
