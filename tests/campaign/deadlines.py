"""Given times against what is possible: is a problem that was refused feasible, infeasible, or not known?"""

from dataclasses import dataclass, field
from math import inf

from tests.campaign.leg_oracle import part_time, run_factor, run_time, smooth_time
from tests.campaign.legs import Leg, runs
from tests.campaign.spec import Spec, number

SURE = 1e-6  # relative: nearer than this to what is just possible, digits decide


@dataclass
class Findings:
    """What is known of the times asked for.

    `earliest` bounds by node what is possible there, `factors`, by the first of them, by how much limits must give in legs
    of given duration; `impossible` says why no law exists, `possible` that one surely does.
    """

    earliest: dict[str, tuple[float, float]] = field(default_factory=dict)
    factors: list[tuple[str, float, float]] = field(default_factory=list)
    impossible: str = ""
    possible: bool = True


@dataclass
class _Walk:
    """Where the tour has come to: bounds on the time, and the legs since the last given one."""

    lower: float = 0.0
    upper: float = 0.0
    rigid: bool = True


def judge_times(spec: Spec, legs: list[Leg]) -> Findings:
    """Walk along the tour from one given time to the next."""
    found, walk = Findings(), _Walk()
    cut = {leg.origin for run in runs(spec, legs, merge=True) for leg in run[:1]} | {legs[-1].target}
    surely = {leg.origin for run in runs(spec, legs, merge=False) for leg in run[:1]} | {legs[-1].target}
    part: list[Leg] = []
    since = legs[0].origin
    visits = len(legs) + 1
    walk.lower = walk.upper = spec.dwell(legs[0].origin, 0, visits)
    for place, leg in enumerate(legs, 1):
        part.append(leg)
        here = leg.target
        last = place == len(legs)
        asked = _asked(spec, here, last, spec.dwell(here, place, visits))
        if asked is None and here not in cut and not last:
            continue
        whole = not any(leg.origin in surely for leg in part[1:])
        _advance(spec, found, walk, part, (since in cut, here in cut), whole=whole)
        part, since = [], here
        if asked is not None:
            _meet(found, walk, here, asked)
        walk.lower += spec.dwell(here, place, visits)
        walk.upper += spec.dwell(here, place, visits)
    return found


def _asked(spec: Spec, label: str, last: bool, dwell: float) -> float | None:
    if "time" in spec.nodes.get(label, {}):
        return number(spec.nodes[label]["time"])
    return spec.total_time - dwell if last and spec.total_time is not None else None


def _advance(
    spec: Spec, found: Findings, walk: _Walk, part: list[Leg], rest: tuple[bool, bool], *, whole: bool
) -> None:
    """Over a part of the tour between given times or stops."""
    fixed = {
        k: number(rule["duration"]) for k, leg in enumerate(part) if "duration" in (rule := _rule(spec, leg))
    }
    if all(rest) and whole and len(fixed) == len(part):
        factor = run_factor(spec, part, list(fixed.values()))
        found.factors.append((f"{part[0].origin}-{part[0].target}", *factor))
        if factor[0] > 1 + SURE:
            found.impossible = (
                f"{part[0].origin}-{part[-1].target} needs limits {factor[0]:.6g} times as large"
            )
        found.possible = found.possible and factor[1] <= 1
        walk.lower, walk.upper = walk.lower + sum(fixed.values()), walk.upper + sum(fixed.values())
        return
    stretchable = [leg for k, leg in enumerate(part) if k not in fixed]
    walk.rigid = walk.rigid and not stretchable
    given = sum(fixed.values())
    if not fixed and all(rest) and whole:
        lower, upper = run_time(spec, part)
    else:
        slow = [smooth_time(spec, leg) for leg in part]
        lower = max(
            part_time(part, rest), given + sum(leg.angle / leg.ceiling.rates[0] for leg in stretchable)
        )
        upper = given + sum(t for k, t in enumerate(slow) if k not in fixed)
        if any(fixed[k] < slow[k] for k in fixed):
            upper, found.possible = inf, False
    walk.lower, walk.upper = walk.lower + lower, walk.upper + upper


def _rule(spec: Spec, leg: Leg) -> dict:
    return spec.legs.get(f"{leg.origin}-{leg.target}", {})


def _meet(found: Findings, walk: _Walk, label: str, asked: float) -> None:
    """A time asked for at a node."""
    found.earliest[label] = walk.lower, walk.upper
    if asked < walk.lower * (1 - SURE):
        found.impossible = f"{label} at {asked:.9g} s is before {walk.lower:.9g} s"
    if walk.rigid and abs(asked - walk.lower) > SURE * walk.lower:
        found.impossible = f"fixed durations put {label} at {walk.lower:.9g} s, not at {asked:.9g} s"
    exact = walk.rigid and abs(asked - walk.lower) <= 1e-12 * walk.lower
    found.possible = found.possible and (exact if walk.rigid else asked >= walk.upper * (1 + SURE))
    walk.lower = asked
    walk.upper = (
        inf if found.impossible else asked
    )  # of what follows a time that cannot be kept no more is known
    walk.rigid = True
