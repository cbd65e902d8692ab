"""The physical limit of a route: one rule, by which everything is measured that is compared with it."""

from math import inf

from timelaw.least_time.physical_limit import run_limit
from timelaw.requirements.requirements import Requirements
from timelaw.requirements.run_demand import RunDemand
from timelaw.route import Route


def find_route_limit(route: Route, requirements: Requirements, *, stop: bool = False) -> float:
    """A time [s] that no law on this route beats: Σ over runs, or with `stop` over legs, and the dwells.

    After a time of arrival that is given, the rest of the route comes on top of that.
    """
    runs = requirements.by_run(route, stop=stop)
    known: dict[object, float] = {}
    for run in runs:
        if run.key() not in known:
            known[run.key()] = run.limit
    limits = [known[run.key()] for run in runs]
    result = requirements.dwell_time + sum(limits)
    for node, time in requirements.arrivals.items():
        result = max(result, time + sum(requirements.dwells[node:]) + _time_after(runs, limits, node))
    return result


def _time_after(runs: list[RunDemand], limits: list[float], node: int) -> float:
    """What the legs after a node take at least; the rest of a run that is cut there is entered at speed."""
    first, time = 0, 0.0
    for run, limit in zip(runs, limits, strict=True):
        rest = run.demands[max(node - first, 0) :]
        if len(rest) == len(run.demands):
            time += limit
        elif rest:
            time += run_limit(rest, (inf, run.speeds[1]))
        first += len(run.demands)
    return time
