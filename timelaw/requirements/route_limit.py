"""The physical limit of a route: one rule, by which everything is measured that is compared with it."""

from timelaw.requirements.requirements import Requirements
from timelaw.route import Route


def find_route_limit(route: Route, requirements: Requirements, *, stop: bool = False) -> float:
    """A time [s] that no law on this route beats: Σ over runs, or with `stop` over legs, and the dwells."""
    known: dict[object, float] = {}
    result = requirements.dwell_time
    for run in requirements.by_run(route, stop=stop):
        if run.key() not in known:
            known[run.key()] = run.limit
        result += known[run.key()]
    return result
