"""Unit vectors, and nodes that are met: how far arcs, joints and dwells are from one motion, added up."""

from collections.abc import Iterator
from itertools import pairwise

from flint import arb

from tests.exact.motion import Motion
from tests.exact.quaternions import Quaternion, measure_turn, normalise
from tests.exact.rational import largest, norm, read_all, show, surely_exceeds

UNIT = 1e-9  # | |v| - 1 |
NODE = 1e-9  # rad of body rotation, in all


def find_long_vectors(motion: Motion) -> list[str]:
    """P1: quaternions and axes that are not of length 1."""
    found = []
    for segment in motion.segments:
        for key in segment.vectors:
            error = abs(norm(read_all(segment.data[key])) - 1)
            if surely_exceeds(error, UNIT):
                found.append(f"P1 {key} of {segment.place} is off unit length by {show(error)}")
    return found


def list_visits(motion: Motion) -> Iterator[tuple[str, list[Quaternion], arb]]:
    """Each visit of a node: what it is called, its stored quaternions in order, and the error brought to it.

    A visit is a leg's end, the dwells after it, and the next leg's start; the first begins and the last
    ends without a leg.
    """
    visit: list[Quaternion] = []
    error = arb(0)
    for segment in motion.segments:
        if not segment.moves:
            visit.append(normalise(segment.start))
            continue
        visit.append(normalise(segment.start))
        yield f"node before {segment.place}", visit, error + segment.miss_start()
        visit, error = [normalise(read_all(segment.data["end"]))], segment.miss_end()
    if motion.periodic:
        # q and -q are one orientation where a motion goes round
        first, arrived = normalise(motion.segments[0].start), visit[0]
        other = [-x for x in first]
        apart = [measure_turn(arrived, sign) for sign in (first, other)]
        visit = [*visit, first if apart[0] < apart[1] else other]
    yield f"node after {motion.segments[-1].place}", visit, error


def find_missed_nodes(motion: Motion) -> list[str]:
    """P3: nodes that are missed, and neighbours with other labels."""
    found = [
        f"P3 {a.place} leads to {a.target!r}, {b.place} begins at {b.origin!r}"
        for a, b in pairwise(motion.segments)
        if a.target != b.origin
    ]
    for name, visit, brought in list_visits(motion):
        apart = largest([measure_turn(visit[0], other) for other in visit[1:]])
        if surely_exceeds(brought + apart, NODE):
            found.append(f"P3 {name} is missed by {show(brought + apart)} rad")
    return found
