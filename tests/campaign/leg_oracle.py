"""Least times of parts of a tour, from below and from above: closed forms, linear programs, smoothsteps."""

from functools import lru_cache
from math import inf

from tests.campaign import least, leg_program
from tests.campaign.leg_program import Space
from tests.campaign.legs import Leg, alike, loosest
from tests.campaign.spec import Spec

MOST_LEGS = 6  # of a run in one linear program
HIGHEST_DEGREE = 15  # of linear programs: beyond, Chebyshev's rows take long
ROOM = {"polynomial": 1.0, "spline": 1.3, "double-s": 1.0, "auto": 1.0}  # for the smoothstep in a basis
AT_LIMIT = 0.9999  # part of a bound that a rate at an end takes
FEW, FEW_ROOM = 12, 2.5  # intervals of a spline that comes near nothing


def physical_time(run: list[Leg]) -> float:
    """No motion from rest to rest over a run is faster."""
    angle, (w, a, j, s) = sum(leg.angle for leg in run), loosest(run)
    at_speed = sum(leg.angle / leg.ceiling.rates[0] for leg in run)
    snap = (384 * angle / s) ** 0.25 if s < inf else 0.0
    return max(least.double_s(angle, w, a, j), at_speed, snap)


def part_time(part: list[Leg], rest: tuple[bool, bool]) -> float:
    """The same for a part of a run that begins or ends at rest or at any speed."""
    if all(rest):
        return physical_time(part)
    w, a, _, _ = loosest(part)
    angle = sum(leg.angle for leg in part)
    return least.double_s(2 * angle, w, a, inf) / 2 if any(rest) else angle / w


def smooth_time(spec: Spec, leg: Leg) -> float:
    """A leg can surely be done in this time from rest to rest, or in any that is longer."""
    room = ROOM[spec.easing["basis"]]
    if spec.easing["basis"] == "spline" and spec.intervals < FEW:
        room = FEW_ROOM
    return room * least.smoothstep_time(leg.angle, spec.continuity, leg.sets, spec.body, leg.axis)


def linear(leg: Leg, start=(), end=()) -> leg_program.Leg:
    """A leg for the linear program, with rates at its ends; bounds that these reach give no room."""
    ceilings = leg.ceiling.by_order
    firm = {
        k
        for rates in (start, end)
        for k, rate in enumerate(rates, 1)
        if abs(rate) > AT_LIMIT * ceilings.get(k, inf)
    }
    bounds = tuple((k, float(b)) for k, b in ceilings.items())
    return leg_program.Leg(leg.angle, bounds, tuple(start), tuple(end), frozenset(firm))


def has_program(spec: Spec, leg: Leg) -> bool:
    """Whether a linear program says all about the leg: plain rates, a polynomial of moderate degree."""
    return spec.easing["basis"] == "polynomial" and spec.degree <= HIGHEST_DEGREE and leg.ceiling.whole


def has_closed_form(spec: Spec, run: list[Leg]) -> bool:
    """Whether the double-S is in the family and nothing but plain rates counts."""
    _, a, j, s = loosest(run)
    contained = spec.easing["basis"] == "double-s" or (spec.easing["basis"] == "spline" and spec.degree == 3)
    profile = 2 if j < inf else 1 if a < inf else 0
    return contained and alike(run) and s == inf and profile >= spec.continuity


@lru_cache(maxsize=256)
def _least_time(leg: leg_program.Leg, degree: int, low: float, high: float) -> tuple[float, float]:
    return leg_program.least_time(leg, Space(degree), low, high)


def leg_time(spec: Spec, leg: Leg) -> tuple[float, float]:
    """(lower, upper) of a single leg's least time from rest to rest, by its linear program."""
    rest = (0.0,) * spec.continuity
    high = least.smoothstep_time(leg.angle, spec.continuity, leg.sets, spec.body, leg.axis) * 1.001
    return _least_time(linear(leg, rest, rest), spec.degree, physical_time([leg]) * (1 - 1e-9), high)


def run_time(spec: Spec, run: list[Leg]) -> tuple[float, float]:
    """(lower, upper) of the least time over a run from rest to rest in the problem's easing."""
    if has_closed_form(spec, run):
        time = least.double_s(sum(leg.angle for leg in run), *loosest(run)[:3])
        return time, time
    if len(run) == 1 and has_program(spec, run[0]):
        return leg_time(spec, run[0])
    return physical_time(run), sum(smooth_time(spec, leg) for leg in run)


def leg_factor(spec: Spec, leg: Leg, time: float, start=None, end=None) -> tuple[float, float]:
    """(lower, upper) of how much limits must give for a leg in a given time; (physics, inf) without a program."""
    rest = (0.0,) * spec.continuity
    moving = start is not None or end is not None
    if has_program(spec, leg):
        return leg_program.least_factor(linear(leg, start or rest, end or rest), time, Space(spec.degree))
    enough = time >= smooth_time(spec, leg) and not moving
    lower = 0.0 if moving else physical_factor([[leg]], time)
    return (lower, lower if has_closed_form(spec, [leg]) else 1.0 if enough else inf)


def run_factor(spec: Spec, run: list[Leg], times: list[float]) -> tuple[float, float]:
    """The same for all legs of a run from rest to rest, each in its own time."""
    if len(run) == 1:
        return leg_factor(spec, run[0], times[0])
    if len(run) > MOST_LEGS or not all(has_program(spec, leg) for leg in run):
        return physical_factor([run], sum(times)), inf
    rest = (0.0,) * spec.continuity
    return leg_program.chain_factor([linear(leg, rest, rest) for leg in run], times, Space(spec.degree))


def physical_factor(found: list[list[Leg]], time: float) -> float:
    """Limits must give at least by this for all runs to be done in the time."""

    def total(p: float) -> float:
        return sum(
            least.double_s(sum(leg.angle for leg in run), *(p * b for b in loosest(run)[:3])) for run in found
        )

    return least.factor_for(time, total)
