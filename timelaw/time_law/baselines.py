"""The laws every optimised law is measured by: the paper's quintic and the double-S profile.

The double-S (S-curve) is the seven-phase profile of constant jerk that is fastest from rest to rest.
Where arrival times or the total time are given, baselines keep them too, whether or not their limits
then hold: what is compared takes the same time.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

from timelaw.easing import Timing, smoothstep
from timelaw.easing.double_s_easing import fit_double_s
from timelaw.limits import Demand
from timelaw.requirements import Requirements
from timelaw.requirements.given_times import Budget, meet_budgets
from timelaw.route import Route
from timelaw.time_law.time_law import TimeLaw

PAPER_CONTINUITY = 2
QUINTIC, DOUBLE_S, EVERY_STOP = "quintic", "double-S", "double-S, every stop"  # what the laws are called


def time_quintic(requirements: Requirements, budgets: Sequence[Budget] = ()) -> TimeLaw:
    """The law of [MMB2017], 6τ⁵ - 15τ⁴ + 10τ³ from stop to stop on every leg, each in its least time.

    Where a leg's duration is fixed, that is its time, whether or not the quintic can keep the limits in it.
    """
    keys = [demand.key() for demand in requirements.demands]
    distinct = dict(zip(keys, requirements.demands, strict=True))
    timings = smoothstep.time_legs(list(distinct.values()), PAPER_CONTINUITY)
    known = {key: _fixed(distinct[key], timing) for key, timing in zip(distinct, timings, strict=True)}
    return _on_time(QUINTIC, [known[key] for key in keys], requirements, budgets)


def time_double_s(
    route: Route, requirements: Requirements, budgets: Sequence[Budget] = (), *, stop: bool = False
) -> TimeLaw:
    """The double-S profile over every run, or with `stop` over every leg, from rest to rest.

    A run in which a time of arrival is given is cut there, since its parts are stretched apart; so it is
    where a leg begins or ends whose duration is fixed.
    """
    fixed = {k for k, demand in enumerate(requirements.demands) if demand.duration is not None}
    nodes = {budget.legs for budget in budgets} | fixed | {k + 1 for k in fixed}
    cut = replace(requirements, stops=requirements.stops | nodes)
    known: dict[object, tuple[Timing, ...]] = {}
    timings: list[Timing] = []
    for run in cut.by_run(route, stop=stop):
        demands = run.demands
        key = tuple(d.key() for d in demands)
        if key not in known:
            known[key] = fit_double_s(demands)
            if len(demands) == 1:
                known[key] = (_fixed(demands[0], known[key][0]),)
        timings += known[key]
    return _on_time(EVERY_STOP if stop else DOUBLE_S, timings, requirements, budgets)


def _fixed(demand: Demand, timing: Timing) -> Timing:
    return timing if demand.duration is None else Timing(demand.duration, timing.easing)


def _on_time(
    name: str, timings: Sequence[Timing], requirements: Requirements, budgets: Sequence[Budget]
) -> TimeLaw:
    """The law in the given times."""
    elastic = [demand.duration is None for demand in requirements.demands]
    return TimeLaw(name, meet_budgets(timings, elastic, budgets), requirements.dwells)


def _double_s(route: Route, requirements: Requirements, budgets: Sequence[Budget]) -> tuple[TimeLaw, ...]:
    """Over the runs, and where a run has more than one leg, stopping at every node too."""
    through = (time_double_s(route, requirements, budgets),)
    one_leg_runs = len(requirements.runs(route)) == len(route.legs)
    return through if one_leg_runs else (*through, time_double_s(route, requirements, budgets, stop=True))


BASELINES: dict[str, Callable[[Route, Requirements, Sequence[Budget]], tuple[TimeLaw, ...]]] = {
    "quintic": lambda _, requirements, budgets: (time_quintic(requirements, budgets),),
    "double-s": _double_s,
}
