"""The laws every optimised law is measured by: the paper's quintic and the double-S profile."""

from collections.abc import Callable

from timelaw.easing import Timing, smoothstep
from timelaw.easing.double_s_easing import fit_double_s
from timelaw.limits import Demand
from timelaw.requirements import Requirements
from timelaw.route import Route
from timelaw.time_law.time_law import TimeLaw

PAPER_CONTINUITY = 2


def time_quintic(requirements: Requirements) -> TimeLaw:
    """The law of [MMB2017], 6τ⁵ - 15τ⁴ + 10τ³ from stop to stop on every leg, each in its least time.

    Where a leg's duration is fixed, that is its time, whether or not the quintic can keep the limits in it.
    """
    known: dict[object, Timing] = {}
    for demand in requirements.demands:
        if demand.key() not in known:
            known[demand.key()] = _fixed(demand, smoothstep.time_leg(demand, PAPER_CONTINUITY))
    return TimeLaw("quintic", tuple(known[d.key()] for d in requirements.demands), requirements.dwells)


def time_double_s(route: Route, requirements: Requirements, *, stop: bool = False) -> TimeLaw:
    """The double-S profile over every run, or with `stop` over every leg, from rest to rest."""
    known: dict[object, tuple[Timing, ...]] = {}
    timings: list[Timing] = []
    for run in requirements.by_run(route, stop=stop):
        demands = run.legs
        key = tuple(d.key() for d in demands)
        if key not in known:
            known[key] = fit_double_s(demands)
            if len(demands) == 1:
                known[key] = (_fixed(demands[0], known[key][0]),)
        timings += known[key]
    return TimeLaw("double-S, every stop" if stop else "double-S", tuple(timings), requirements.dwells)


def _fixed(demand: Demand, timing: Timing) -> Timing:
    return timing if demand.duration is None else Timing(demand.duration, timing.easing)


def _double_s(route: Route, requirements: Requirements) -> tuple[TimeLaw, ...]:
    """Over the runs, and where a run has more than one leg, stopping at every node too."""
    through = (time_double_s(route, requirements),)
    one_leg_runs = len(requirements.runs(route)) == len(route.legs)
    return through if one_leg_runs else (*through, time_double_s(route, requirements, stop=True))


BASELINES: dict[str, Callable[[Route, Requirements], tuple[TimeLaw, ...]]] = {
    "quintic": lambda _, requirements: (time_quintic(requirements),),
    "double-s": _double_s,
}
