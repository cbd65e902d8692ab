"""Is a refusal right? What an oracle says of the problem, and of the numbers in the message."""

import re
from dataclasses import replace
from math import inf

import numpy as np

from tests.campaign import braking, least, leg_program
from tests.campaign.deadlines import Findings, judge_times
from tests.campaign.leg_oracle import has_program, leg_factor, linear, physical_factor
from tests.campaign.legs import Leg, loosest, runs
from tests.campaign.spec import Spec, number
from tests.campaign.times import known_legs

CONFIRMED, UNCONFIRMED, WRONG = "refused-confirmed", "refused-unconfirmed", "wrong"
SEGMENT = re.compile(r"segments\.(\S+)\.duration: ")
FACTOR = re.compile(r"limits would have to be (\S+) times as large")
EARLY = re.compile(
    r"(\S+) s is too early for (?:arrival at (.+?)|the end): the earliest possible is (not before )?(\S+) s"
)
BRAKING = re.compile(r"takes (\S+)° at least under the limits; the run there has (\S+)°")
REACHED = re.compile(r"nodes\.(start|end)\.\w+: under .* (?:goes on to|has come from) (\S+) .* at least")
BROKEN = re.compile(r"nodes\.(?:start|end)\.\w+: (\S+) times as much as the limit on")
BACKWARDS = re.compile(r"(\S+) s: the body is at .+, earlier on the tour, until (\S+) s")
PLACE = re.compile(r":\d+:\d+: \S+")
SAME = 1e-3  # of a factor
ON_TIME = 2e-5  # of an earliest time
SAME_ORIENTATION = 1e-6
AXIS = 20  # times the precision over the angle: what an axis component, and a limit on it, may be off
JERK_COUNTS = 2  # continuity from which on the acceleration does not jump
RICH = 1.05  # what a spline of another division may make of a factor


def judge_input_error(spec: Spec, message: str) -> tuple[str, str]:
    """Of a problem that is called wrong."""
    legs = known_legs(spec)
    if "follow each other and are the same orientation" in message:
        blur = 1e-9 + spec.precision
        close = legs and min(leg.angle for leg in legs) < SAME_ORIENTATION + blur
        return (CONFIRMED, "") if close else (WRONG, "no two orientations in a row are the same")
    if "no limit bounds the motion of leg" in message:
        open_legs = [leg for leg in legs if min(leg.ceiling.rates[:3]) == inf]
        return (CONFIRMED, "") if open_legs else (WRONG, "every leg has a limit")
    if BROKEN.search(message):
        return (
            (CONFIRMED, "")
            if _breaks_at_an_end(spec, legs)
            else (WRONG, "the rates at the ends are within the limits")
        )
    if backwards := BACKWARDS.search(message):
        return (
            (CONFIRMED, "") if float(backwards.group(1)) <= float(backwards.group(2)) else (WRONG, "in order")
        )
    if "is given both as a norm and by axis" in message:
        return CONFIRMED, ""
    return UNCONFIRMED, "no oracle knows this message"


def _breaks_at_an_end(spec: Spec, legs: list[Leg]) -> bool:
    """Whether a rate at the start or the end is above its limit on the leg there."""
    ends = ((legs[0], spec.end_rates("start")), (legs[-1], spec.end_rates("end")))
    return any(
        abs(rate) > leg.ceiling.rates[k] * (1 + 1e-12 - AXIS * spec.precision / leg.angle)
        for leg, rates in ends
        for k, rate in enumerate(rates)
    )


def judge_refusal(spec: Spec, message: str) -> tuple[str, str]:
    """Of a problem that is said to have no solution: verdict, and what speaks for it."""
    if spec.through:
        given = spec.timed or spec.moving or spec.objective["minimise"] != "time"
        return (
            (UNCONFIRMED, "no oracle knows these motions")
            if given
            else (WRONG, "stopping is always possible")
        )
    factor = float(found.group(1)) if (found := FACTOR.search(message)) else None
    if factor is not None and not factor > 1:
        return WRONG, f"limits {factor:g} times as large are the ones that were given"
    if not PLACE.search(message):
        return WRONG, "the message names no place"
    if not spec.timed and not spec.moving:
        return WRONG, "from rest to rest without given times there is always a law"
    only_relative = (
        spec.stretch is not None and not spec.legs and not any("time" in r for r in spec.nodes.values())
    )
    if only_relative and not spec.moving:
        return WRONG, "a multiple of the least time is always possible"
    legs = known_legs(spec)
    if not legs:
        return UNCONFIRMED, "the tour is not known to the oracles"
    if spec.moving:
        return _judge_moving(spec, legs, factor, message)
    return _judge_times(spec, legs, message)


def _judge_times(spec: Spec, legs: list[Leg], message: str) -> tuple[str, str]:
    found = judge_times(spec, legs)
    if found.possible:
        return WRONG, "possible: " + _show(found)
    early = EARLY.search(message)
    if early is not None and (wrong := _wrong_earliest(spec, legs, found, early)):
        return WRONG, wrong
    for line in message.splitlines():
        stated, place = FACTOR.search(line), SEGMENT.search(line)
        where = place.group(1) if place else ""
        if stated and (wrong := _wrong_factor(spec, legs, found, where, float(stated.group(1)))):
            return WRONG, wrong
    return (CONFIRMED, found.impossible) if found.impossible else (UNCONFIRMED, _show(found))


def _show(found: Findings) -> str:
    parts = [f"{label} from {low:.9g} to {high:.9g} s" for label, (low, high) in found.earliest.items()]
    parts += [f"limits {low:.9g} to {high:.9g} times as large" for _, low, high in found.factors]
    return "; ".join(parts)


def _wrong_earliest(spec: Spec, legs: list[Leg], found: Findings, early: re.Match) -> str:
    """What is wrong with the earliest time that a message states."""
    asked, label, earliest = float(early.group(1)), early.group(2) or legs[-1].target, float(early.group(4))
    dwell = 0.0 if early.group(2) else spec.dwell(label, len(legs), len(legs) + 1)
    low, high = (t + dwell for t in found.earliest.get(label, (0.0, inf)))
    wanted = spec.total_time if early.group(2) is None else number(spec.nodes[label]["time"])
    if wanted is not None and abs(asked - wanted) > 1e-5 * wanted:
        return f"{asked} s was not asked for at {label}, but {wanted}"
    if early.group(3):  # no more is said than that
        low = 0.0
    if not low * (1 - ON_TIME) <= earliest <= high * (1 + ON_TIME):
        return f"the earliest possible is {low:.9g} to {high:.9g} s, not {earliest}"
    return ""


def _wrong_factor(spec: Spec, legs: list[Leg], found: Findings, place: str, factor: float) -> str:
    """What is wrong with a factor that a message states at a place."""
    known = [(low, high) for key, low, high in found.factors if not place or key == place]
    if len(legs) == 1 and spec.total_time is not None:
        dwells = spec.dwell(legs[0].origin, 0, 2) + spec.dwell(legs[0].target, 1, 2)
        known.append(leg_factor(spec, legs[0], spec.total_time - dwells))
    elif spec.total_time is not None and not spec.legs and len(found.earliest) == 1:
        plain = [run for run in runs(spec, legs, merge=True) if min(loosest(run)[:3]) < inf]
        known.append((physical_factor(plain, spec.total_time), inf))
    stated = [(low, high) for low, high in known if high > 1]
    if not stated or len(found.earliest) > 1:
        return ""
    if any(low * (1 - SAME) <= factor <= high * (1 + SAME) for low, high in stated):
        return ""
    return f"a factor of {factor}; the oracle says " + ", ".join(
        f"{low:.6g} to {high:.6g}" for low, high in stated
    )


def _judge_moving(spec: Spec, legs: list[Leg], factor: float | None, message: str) -> tuple[str, str]:
    """Of a motion between given rates: one leg by a linear program over all times."""
    if _breaks_at_an_end(spec, legs):
        return CONFIRMED, "a rate at the start or the end is above its limit"
    if _steady(spec, legs):
        return WRONG, "possible: a steady turn"
    if spec.timed or not all(leg.ceiling.whole for leg in legs):
        return UNCONFIRMED, "no program for torque or given times beside rates at the ends"
    ends = _end_runs(spec, legs)
    if said := REACHED.search(message):
        return _judge_reached(ends, said.group(1), float(said.group(2)))
    if said := BRAKING.search(message):
        return _judge_braking(ends, float(said.group(1)), float(said.group(2)))
    if any(len(run) > 1 for run, _, _ in ends):
        return UNCONFIRMED, "no program for several legs in a run"
    return _weigh(spec, has_program(spec, legs[0]), ends, factor)


def _judge_reached(ends, end: str, top: float) -> tuple[str, str]:
    """Of rates at an end that are said to carry the body beyond a limit: by constant jerk (or snap) to none."""
    run, start, finish = ends[0 if end == "start" else -1]
    rates, sign = (start, 1) if end == "start" else (finish, -1)
    bounds = loosest(run)
    for k in range(len(rates) - 1):
        if k + 2 < len(bounds) and bounds[k + 2] < inf:
            time = abs(rates[k + 1]) / bounds[k + 2]
            reached = np.degrees(abs(rates[k] + sign * rates[k + 1] * time / 2))
            if abs(reached / top - 1) < SAME:
                wrong = reached <= np.degrees(bounds[k])
                return (WRONG, "the rates there leave room") if wrong else (CONFIRMED, "")
    return WRONG, "no rate there goes so far"


def _judge_braking(ends, needed: float, angle: float) -> tuple[str, str]:
    """Of a motion that is said to be too fast for its run: by the ways to change speed, and to come to rest."""
    for run, start, end in ends:
        _, a, j = loosest(run)[:3]
        j = inf if any((*start[1:], *end[1:])) or len(start) < JERK_COUNTS else j
        fast, slow = max(start[0], end[0]), min(start[0], end[0])
        onwards, stopping = braking.least_change(fast, slow, a, j), braking.least_stop(fast, a, j)
        own = sum(leg.angle for leg in run)
        said = onwards if slow else stopping
        if abs(np.degrees(own) / angle - 1) < SAME and abs(np.degrees(said) / needed - 1) < SAME:
            impossible = onwards > own and stopping > own + np.pi
            return (CONFIRMED, "") if impossible else (WRONG, "the run is long enough")
    return WRONG, "no run has that angle, or needs that much"


def _weigh(spec: Spec, exact: bool, ends, factor: float | None) -> tuple[str, str]:
    """Possible if a law exists that stays on its arcs, not if there is none however far it runs beyond them."""
    staying, free = (
        [_moving_factor(spec, run[0], start, end, stay=stay) for run, start, end in ends]
        for stay in (True, False)
    )
    says = "; ".join(
        f"limits {low:.9g} to {high:.9g} times as large in {time:.9g} s" for time, low, high in staying
    )
    room = 1 - 1e-5 if exact else 1 / RICH if spec.intervals >= 28 else 0.0
    if all(high <= room for _, _, high in staying):
        return WRONG, "possible: " + says
    broken = [low for _, low, _ in free if low > (1 + 1e-6 if exact else RICH)]
    least_of, most = min(broken, default=0.0), max(high for _, _, high in staying)
    known = exact and bool(broken) and least_of < inf  # without end where a firm bound leaves no room at all
    if factor is not None and known and not least_of * (1 - SAME) <= factor <= most * (1 + SAME):
        return WRONG, f"a factor of {factor}; {says}"
    return (CONFIRMED, says) if broken else (UNCONFIRMED, says)


def _end_runs(spec: Spec, legs: list[Leg]):
    """Runs that begin or end at speed, with their rates at both ends; the others are always possible."""
    found = runs(spec, legs, merge=True)
    rest = [0.0] * spec.continuity
    start, end = spec.end_rates("start"), spec.end_rates("end")
    if len(found) == 1:
        return [(found[0], start, end)]
    return [
        (run, a, b) for run, a, b in ((found[0], start, rest), (found[-1], rest, end)) if any(a) or any(b)
    ]


def _moving_factor(spec: Spec, leg: Leg, start, end, *, stay: bool) -> tuple[float, float, float]:
    """(time, lower, upper) of the least factor over all times."""
    space = leg_program.Space(spec.degree) if has_program(spec, leg) else _rich(spec)
    guess = max(
        least.double_s(leg.angle, *leg.ceiling.rates[:3]), leg.angle / max(*start[:1], *end[:1], 1e-300)
    )
    return leg_program.least_factor_over_times(replace(linear(leg, start, end), stay=stay), space, guess)


def _steady(spec: Spec, legs: list[Leg]) -> bool:
    """Whether the body can turn on as it enters, all the way."""
    start, end = spec.end_rates("start"), spec.end_rates("end")
    calm = start[:1] == end[:1] and start[0] > 0 and not any(start[1:]) and not any(end[1:])
    one = len(runs(spec, legs, merge=False)) == 1 and not spec.timed
    return calm and one and all(leg.ceiling.whole and start[0] <= leg.ceiling.rates[0] for leg in legs)


def _rich(spec: Spec) -> leg_program.Space:
    """Splines, or polynomials of high degree by splines of degree 7, on intervals of one length."""
    degree = spec.degree if spec.easing["basis"] == "spline" else 7
    return leg_program.Space(degree, tuple(k / 40 for k in range(41)))
