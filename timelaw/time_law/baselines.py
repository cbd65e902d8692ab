"""The laws every optimised law is measured by: the paper's quintic and the double-S profile."""

from collections.abc import Callable, Sequence

from timelaw.easing import Timing, fit_to_limits, smoothstep
from timelaw.easing.double_s import bounds, fitted_run_timings, least_time
from timelaw.limits import Rate
from timelaw.route import Route
from timelaw.time_law.time_law import TimeLaw

PAPER_CONTINUITY = 2


def quintic(route: Route, limits: Sequence[Rate]) -> TimeLaw:
    """The law of [MMB2017], 6τ⁵ - 15τ⁴ + 10τ³ from stop to stop on every leg, each in its least time."""

    def leg(angle: float) -> tuple[Timing, ...]:
        return fit_to_limits([angle], [smoothstep.leg_timing(angle, limits, PAPER_CONTINUITY)], limits)

    known = {angle: leg(angle) for angle in {leg.angle for leg in route.legs}}
    return TimeLaw("quintic", tuple(timing for leg in route.legs for timing in known[leg.angle]))


def double_s(route: Route, limits: Sequence[Rate], *, stop: bool = False) -> TimeLaw:
    """The double-S profile over every run, or with `stop` over every leg."""
    chains = [(leg.angle,) for leg in route.legs] if stop else [run.angles for run in route.runs]
    known = {angles: fitted_run_timings(angles, limits) for angles in set(chains)}
    name = "double-S, every stop" if stop else "double-S"
    return TimeLaw(name, tuple(timing for angles in chains for timing in known[angles]))


def _double_s(route: Route, limits: Sequence[Rate]) -> tuple[TimeLaw, ...]:
    """Over the runs, and where a run has more than one leg, stopping at every node too."""
    through = (double_s(route, limits),)
    return (*through, double_s(route, limits, stop=True)) if route.straight_nodes else through


BASELINES: dict[str, Callable[[Route, Sequence[Rate]], tuple[TimeLaw, ...]]] = {
    "quintic": lambda route, limits: (quintic(route, limits),),
    "double-s": _double_s,
}


def physical_limit(route: Route, limits: Sequence[Rate], *, stop: bool = False) -> float:
    """Least time [s] of any law on this route, in closed form: Σ over runs (or legs) of the double-S."""
    totals = [leg.angle for leg in route.legs] if stop else [sum(run.angles) for run in route.runs]
    return sum(run_limit(total, limits) for total in totals)


def run_limit(angle: float, limits: Sequence[Rate]) -> float:
    """Least time [s] over `angle` from rest to rest, in closed form."""
    return least_time(angle, *bounds(limits))
