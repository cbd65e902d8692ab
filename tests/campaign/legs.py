"""The legs of a tour as the judge sees them: axes, angles, and where the body may go straight on."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from tests.campaign.attitude import axes_apart, turn
from tests.campaign.bounds import Ceiling, ceiling, sets_on
from tests.campaign.spec import Spec

HALF = 1e-8  # rad from half a turn; nearer than this either way round is the shorter
SURELY_STRAIGHT, SURELY_CORNER = 3e-8, 3e-6  # rad between axes; between them the program may say either


@dataclass(frozen=True)
class Leg:
    """From label to label: unit axis (3,), angle [rad], and whether it may go the other way round."""

    origin: str
    target: str
    axis: np.ndarray
    angle: float
    half: bool
    sets: tuple
    ceiling: Ceiling


def lay(spec: Spec, labels: list[str], points: dict) -> list[Leg]:
    """The legs between the labels in a row."""
    legs = []
    for origin, target in pairwise(labels):
        axis, angle = turn(points[origin], points[target])
        sets = sets_on(spec, origin, target)
        legs.append(
            Leg(
                origin, target, axis, angle, np.pi - angle < HALF, tuple(sets), ceiling(sets, spec.body, axis)
            )
        )
    return legs


def straight(before: Leg, after: Leg, precision: float) -> bool | None:
    """Whether the body may pass at speed; None where that is a matter of digits."""
    apart = axes_apart(before.axis, after.axis)
    if before.half or after.half:
        apart = min(apart, np.pi - apart)
    blur = 2 * precision / min(before.angle, after.angle)
    if apart <= SURELY_STRAIGHT and not blur:
        return True
    if apart > SURELY_CORNER + 4 * blur:
        return False
    return None


def passes_at(spec: Spec, legs: list[Leg]) -> list[bool | None]:
    """Whether the body may pass each inner node; None too where half-turns cannot go straight on at all of them.

    A half-turn may go either way round, but one way: between two other legs about its axis in opposite
    senses it goes straight on at one of its ends only, and which is a matter of choice.
    """
    found = [straight(a, b, spec.precision) for a, b in pairwise(legs)]
    first, sense, fixed = 0, 1.0, not legs[0].half
    for place, (before, after) in enumerate(pairwise(legs)):
        if not found[place]:
            first, sense, fixed = place + 1, 1.0, not after.half
            continue
        sense *= float(np.sign(before.axis @ after.axis))
        if after.half:
            continue
        if fixed and sense < 0:
            found[first : place + 1] = [None] * (place + 1 - first)
        first, sense, fixed = place + 1, 1.0, True
    return found


def runs(spec: Spec, legs: list[Leg], *, merge: bool) -> list[list[Leg]]:
    """The chains of legs between stops; what is not sure is `merge`d or not."""
    found = [[legs[0]]]
    passing = passes_at(spec, legs)
    for place, after in enumerate(legs[1:], 1):
        passes = passing[place - 1]
        stops = (
            spec.nodes.get(after.origin, {}).get("stop", False)
            or spec.dwell(after.origin, place, len(legs) + 1) > 0
        )
        if stops or not (merge if passes is None else passes):
            found.append([after])
        else:
            found[-1].append(after)
    return found


def sure(spec: Spec, legs: list[Leg]) -> bool:
    """Whether it is plain at every node if the axis turns there."""
    return None not in passes_at(spec, legs)


def loosest(run: list[Leg]) -> tuple[float, float, float, float]:
    """Of each rate the bound that holds wherever the body is on the run."""
    return tuple(max(bounds) for bounds in zip(*(leg.ceiling.rates for leg in run), strict=True))


def alike(run: list[Leg]) -> bool:
    """Whether all legs have the same plain bounds, so that closed forms say all."""
    first = run[0].ceiling.rates
    same = all(np.allclose(leg.ceiling.rates, first, rtol=1e-12, atol=0) for leg in run)
    return same and all(leg.ceiling.whole for leg in run)
