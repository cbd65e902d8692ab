"""What is to be said of a tour: its merits, the notes on its orientations, the paper's distance table."""

from decimal import ROUND_FLOOR, ROUND_HALF_EVEN, Decimal
from math import ceil, isfinite
from typing import Any

import numpy as np

from timelaw.errors import list_some
from timelaw.numerics.array import Array
from timelaw.orientations import OrientationSet
from timelaw.route import Route
from timelaw.tours import Tour
from timelaw.tours.fastest import TIME
from timelaw.tours.merit import LENGTH, Merit
from timelaw.tours.shortest import MINIMAL
from timelaw.tours.straightest import STRAIGHT, TURNING

ANGLES = (LENGTH, TURNING)
WORDS = {  # what it is, what no tour is beyond the bound, what this one is beyond it
    LENGTH: (LENGTH, "shorter", "too long"),
    TURNING: ("the axis turns by", "calmer", "too much"),
    TIME: ("least time over its runs", "faster", "too slow"),
}


def describe_merits(tour: Tour) -> list[str]:
    """One sentence on each merit of a tour: what it is, what no tour can beat, and how that is known."""
    return [_sentence(tour, merit) for merit in tour.merits]


def describe_order(tour: Tour) -> list[str]:
    """What the report says of a tour: what it was searched for, and what is best in it whoever chose it.

    An order that is given is a requirement: nothing is said of how long it is against others.
    """
    told = [_sentence(tour, merit) for merit in tour.merits if merit.asked or merit.is_best]
    length = _quantity(tour.merits[0], tour.length)
    return told or [f"the order of visits is the one given, {length} in all"]


def list_merit_data(merit: Merit) -> dict[str, Any]:
    """A merit as plain data; angles in degrees; no gap where the bound says nothing."""
    scale = np.degrees(1.0) if merit.name in ANGLES else 1.0
    return {
        "name": merit.name,
        "value": merit.value * scale,
        "bound": merit.bound * scale,
        "gap": merit.gap if isfinite(merit.gap) else None,
        "is_best": merit.is_best,
        "proof": merit.proof,
    }


def _sentence(tour: Tour, merit: Merit) -> str:
    nodes = len(tour.visits()) - 2
    if merit.name == STRAIGHT:
        text = f"{merit.value:.0f} of {nodes} inner nodes go straight on; by {merit.proof} "
        return text + (
            "no tour by minimal legs has more" if merit.is_best else f"{merit.bound:.0f} at most can"
        )
    what, comparative, excess = WORDS[merit.name]
    value, bound = _quantity(merit, merit.value), _quantity(merit, merit.bound, down=not merit.is_best)
    if not isfinite(merit.gap):
        return f"{what} {value}; no bound is known for how much {comparative} a tour can be"
    if merit.proof == MINIMAL:
        count = f"{tour.legs} leg{'s' if tour.legs > 1 else ''}"
        legs = f"{count} × the minimal distance {np.degrees(tour.minimal):.6g}°"
        if merit.is_best:
            return f"no tour is shorter: {legs} = {value}"
        bound = f"{legs} = {bound}"
    elif merit.is_best:
        return f"{what} {value}; no tour is {comparative}: {merit.proof}"
    else:
        bound = f"{bound} ({merit.proof})"
    most = ceil(merit.gap * 1e4) / 1e4  # never said smaller than it is
    return (
        f"{what} {value}; no tour is {comparative} than {bound}, so this one is at most {most:.2%} {excess}"
    )


def _quantity(merit: Merit, number: float, *, down: bool = False) -> str:
    """An angle to six digits or a time to 0.1 ms, bounds never above what is proved."""
    angle = merit.name in ANGLES
    shown = Decimal(np.degrees(number) if angle else number)
    step = Decimal(1).scaleb(shown.adjusted() - 5 if angle else -4)
    rounded = (shown / step).to_integral_value(ROUND_FLOOR if down else ROUND_HALF_EVEN) * step
    return f"{float(rounded):.6g}°" if angle else f"{rounded:.4f} s"


def list_notes(points: OrientationSet, route: Route) -> list[str]:
    """What there is to say of the orientations: what was left out, merged, is the same, or was moved."""
    same = list_some([f"{other} is {one}" for one, other in points.same])
    return [
        *points.notes,
        *([f"some orientations are the same, q and -q being one: {same}"] if points.same else []),
        *describe_moves(points, route),
    ]


def describe_moves(points: OrientationSet, route: Route) -> list[str]:
    """Sentences on visits that are one node, and on nodes that were moved to go straight on, and how far."""
    merged = [
        f'"{label}" and "{route.nodes[index].label}" follow each other and are the same orientation: one node'
        for label, index in route.merged.items()
    ]
    if not (moved := route.moved):
        return merged
    farthest = max(moved, key=lambda label: moved[label])
    verb = "is" if len(moved) == 1 else "are"
    each = list_some([f"{label} by {_small(angle)}" for label, angle in moved.items()])
    return [
        *merged,
        f"{len(moved)} of {len(points)} nodes {verb} moved onto great circles that they lie on within the "
        f"precision of the input ({points.precision.origin}: {_small(points.precision.angle)}), so that the "
        f"body goes straight on, node {farthest} farthest, by {_small(moved[farthest])}: {each}",
    ]


def _small(angle: float) -> str:
    """A small angle in degrees, to three digits."""
    return f"{np.degrees(angle):.3g}°"


def measure_arcs(points: OrientationSet) -> Array:
    """arccos(q_i·q_j) (N, N) [rad] on S³, without absolute value, as table 1 of [MMB2017] has it."""
    return np.arccos(np.clip(points.quaternions @ points.quaternions.T, -1.0, 1.0))
