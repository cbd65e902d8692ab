"""What a problem's rules mean for travel times: which nodes may be passed, slower legs, dwells."""

from timelaw.errors import Fault, InputError, list_some
from timelaw.limits import make_limits
from timelaw.orientations import OrientationSet
from timelaw.problem import Problem
from timelaw.progress import Progress
from timelaw.tours.travel_times import TravelTimes


def make_travel_times(problem: Problem, points: OrientationSet, progress: Progress | None) -> TravelTimes:
    """Times of motions under the limits, the general ones and those at nodes, and of all dwells.

    Raises:
        InputError: a rule that has no meaning before there is a route, or a node that is none.
    """
    _refuse_what_cannot_be_timed(problem)
    rules = problem.nodes.at
    unknown = [label for label in rules if label not in points.labels]
    if unknown:
        message = f'no orientation is called "{unknown[0]}"; there are {list_some(points.labels)}'
        raise InputError(Fault(message, f"nodes.at.{unknown[0]}"))
    general, own = problem.nodes.dwell, {label: rule.dwell for label, rule in rules.items()}
    dwells = {label: general if own.get(label) is None else own[label] or 0.0 for label in points.labels}
    stops = {label for label, rule in rules.items() if rule.stop}
    passable = [i for i, label in enumerate(points.labels) if not (label in stops or dwells[label] > 0)]
    body = problem.rigid_body()
    slower = {
        points.labels.index(label): make_limits(rule.limits.given(), body)
        for label, rule in rules.items()
        if rule.limits
    }
    return TravelTimes(
        points.quaternions,
        make_limits(problem.limits.given(), body),
        passable,
        progress,
        slower,
        sum(dwells.values()),
        points.precision.angle,
    )


def _refuse_what_cannot_be_timed(problem: Problem) -> None:
    """The fastest tour is known by the times between any two orientations, from rest to rest."""
    rest = '"fastest" compares motions from rest to rest'
    legs = '"fastest" chooses the legs; give the tour it finds as a list or with given'
    wrong = [
        *((f"nodes.{key}", rest) for key in ("start", "end") if getattr(problem.nodes, key)),
        *(
            (f"nodes.at.{label}.time", f"{rest}, whenever they begin")
            for label, r in problem.nodes.at.items()
            if r.time is not None
        ),
        *((f"segments.{name}", legs) for name in problem.segments),
    ]
    if wrong:
        raise InputError(*(Fault(message, where) for where, message in wrong))
