"""Whether two laws take the body through the same nodes, and what differs where they do not."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from timelaw.limits.bounds import write_bounds
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between
from timelaw.numerics.turn import SAME_ORIENTATION

SAME_PLACE = 1e-6  # of the farthest place; the origin's places at nodes nearer than that are one


@dataclass(frozen=True)
class Nodes:
    """What a law visits: labels, orientations (n, 4), and where the origin moves its places (n, 3) [m]."""

    labels: tuple[str, ...]
    orientations: Array
    places: Array | None


def list_nodes(law: QuaternionLaw) -> Nodes:
    """In order, a rest once."""
    legs = law.legs
    labels = (legs[0].origin, *(leg.target for leg in legs))
    orientations = np.array([legs[0].start, *(leg.end for leg in legs)])
    times = np.array([legs[0].start_time, *(leg.end_time for leg in legs)])
    return Nodes(labels, orientations, law.place(times) if law.travels else None)


def find_route_difference(one: QuaternionLaw, other: QuaternionLaw) -> str:
    """How the second's route differs from the first's, in one sentence; empty if they are the same."""
    a, b = list_nodes(one), list_nodes(other)
    if len(a.labels) != len(b.labels):
        return f"it has {len(b.labels)} nodes, not {len(a.labels)}"
    angles = angle_between(a.orientations, b.orientations)
    apart = np.flatnonzero(angles > SAME_ORIENTATION)
    if len(apart):
        k = int(apart[0])
        many = f" and {len(apart) - 1} more" if len(apart) > 1 else ""
        return (
            f'node {k + 1} of {len(a.labels)}, "{b.labels[k]}", is {np.degrees(angles[k]):.4g}° away from '
            f'"{a.labels[k]}"{many}'
        )
    if (a.places is None) != (b.places is None):
        return "the body's origin moves in one of them only"
    if a.places is not None and b.places is not None:
        far = np.linalg.norm(a.places - b.places, axis=1)
        k = int(np.argmax(far))
        if far[k] > SAME_PLACE * max(float(np.max(np.abs(a.places))), 1.0):
            return f'the origin is {far[k]:.4g} m away at node {k + 1}, "{b.labels[k]}"'
    return ""


def list_setting_differences(laws: Sequence[tuple[str, QuaternionLaw]]) -> list[str]:
    """What else differs from the first: limits, rest, the class that was asked for, one sentence each."""
    (first, reference), *others = laws
    found = []
    for name, law in others:
        if _list_limits(law) != _list_limits(reference):
            found.append(f"{name} has other limits than {first}")
        rests = [sum(s.duration for s in law_.segments if not s.moves) for law_ in (reference, law)]
        if abs(rests[1] - rests[0]) > 1e-9 * max(rests):
            found.append(f"{name} rests for {rests[1]:.6g} s in all, {first} for {rests[0]:.6g} s")
        if law.continuity != reference.continuity:
            found.append(f"{name} was asked to be C{law.continuity}, {first} C{reference.continuity}")
    return found


def _list_limits(law: QuaternionLaw) -> object:
    """General limits, and those of single legs in their order; to 12 digits, as files round them."""

    def round_all(limits: dict[str, object]) -> list[tuple[str, str]]:
        return sorted((name, np.array2string(np.asarray(b), precision=12)) for name, b in limits.items())

    return [round_all(write_bounds(limits)) for limits in (law.limits, *(leg.limits for leg in law.legs))]
