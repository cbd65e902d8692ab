"""The laws every optimised law is measured by: the paper's quintic and the double-S profile."""

from collections.abc import Callable, Sequence

from timelaw.easing import Timing, smoothstep
from timelaw.easing.double_s_easing import fit_double_s
from timelaw.least_time import physical_limit as limit
from timelaw.limits import Demand
from timelaw.route import Route
from timelaw.schedule import Schedule
from timelaw.time_law.time_law import TimeLaw

PAPER_CONTINUITY = 2


def quintic(schedule: Schedule) -> TimeLaw:
    """The law of [MMB2017], 6τ⁵ - 15τ⁴ + 10τ³ from stop to stop on every leg, each in its least time.

    Where a leg's duration is fixed, that is its time, whether or not the quintic can keep the limits in it.
    """
    known: dict[object, Timing] = {}
    for demand in schedule.demands:
        if demand.key() not in known:
            known[demand.key()] = _fixed(demand, smoothstep.time_leg(demand, PAPER_CONTINUITY))
    return TimeLaw("quintic", tuple(known[d.key()] for d in schedule.demands), schedule.dwells)


def double_s(route: Route, schedule: Schedule, *, stop: bool = False) -> TimeLaw:
    """The double-S profile over every run, or with `stop` over every leg, from rest to rest."""
    known: dict[object, tuple[Timing, ...]] = {}
    timings: list[Timing] = []
    for demands in chains(route, schedule, stop=stop):
        key = tuple(d.key() for d in demands)
        if key not in known:
            known[key] = fit_double_s(demands)
            if len(demands) == 1:
                known[key] = (_fixed(demands[0], known[key][0]),)
        timings += known[key]
    return TimeLaw("double-S, every stop" if stop else "double-S", tuple(timings), schedule.dwells)


def _fixed(demand: Demand, timing: Timing) -> Timing:
    return timing if demand.duration is None else Timing(demand.duration, timing.easing)


def chains(route: Route, schedule: Schedule, *, stop: bool = False) -> list[Sequence[Demand]]:
    """The demands run by run, or with `stop` leg by leg."""
    if stop:
        return [[demand] for demand in schedule.demands]
    return [[schedule.demands[k] for k in run.legs] for run in schedule.runs(route)]


def _double_s(route: Route, schedule: Schedule) -> tuple[TimeLaw, ...]:
    """Over the runs, and where a run has more than one leg, stopping at every node too."""
    through = (double_s(route, schedule),)
    one_leg_runs = len(schedule.runs(route)) == len(route.legs)
    return through if one_leg_runs else (*through, double_s(route, schedule, stop=True))


BASELINES: dict[str, Callable[[Route, Schedule], tuple[TimeLaw, ...]]] = {
    "quintic": lambda _, schedule: (quintic(schedule),),
    "double-s": _double_s,
}


def physical_limit(route: Route, schedule: Schedule, *, stop: bool = False) -> float:
    """A time [s] that no law on this route beats: Σ over runs (or legs), and the dwells.

    A run that is entered or left moving has the velocity limit alone for a bound.
    """
    known: dict[object, float] = {}
    result = schedule.dwell_time
    runs = chains(route, schedule, stop=stop)
    for index, demands in enumerate(runs):
        moving = (index == 0 and any(schedule.start)) or (index == len(runs) - 1 and any(schedule.end))
        key = (moving, *(d.key() for d in demands))
        if key not in known:
            known[key] = limit.run_limit(demands, moving=moving)
        result += known[key]
    return result
