"""Times of arrival that a problem gives, in the order in which the tour has them."""

from collections.abc import Mapping, Sequence
from itertools import pairwise

from timelaw.errors import Fault, InputError
from timelaw.problem.objective import TotalTime
from timelaw.route import Route


def check_arrivals(
    route: Route, arrivals: Mapping[int, float], dwells: Sequence[float], total: TotalTime | None
) -> None:
    """Refuse times that run backwards: the body cannot be anywhere before it has left where it was last.

    Raises:
        InputError: at the key of the time that comes too early.
    """
    last = len(route.nodes) - 1
    given = [(node, time, f"nodes.at.{route.nodes[node].label}.time") for node, time in arrivals.items()]
    given.sort()
    if total is not None and not total.relative:
        given.append((last, total.value, "objective.total_time"))
    for (node, time, _), (following, later, where) in pairwise(given):
        departure = time + dwells[node]
        if later < departure or (later == departure and following > node):
            label = route.nodes[node].label
            message = f"{later:.9g} s: the body is at {label}, earlier on the tour, until {departure:.9g} s"
            raise InputError(Fault(message, where))
