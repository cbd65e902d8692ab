"""Unit vectors, and nodes that are met: how far arcs, joints and dwells are from one motion, added up."""

from collections.abc import Iterator
from itertools import pairwise

from flint import arb

from tests.exact.motion import Motion, Segment
from tests.exact.rational import largest, norm, read, read_all, show, surely_exceeds

UNIT = 1e-9  # | |v| - 1 |
NODE = 1e-9  # rad of body rotation, in all

Quaternion = list[arb]


def normalise(vector: list) -> list[arb]:
    """The unit vector."""
    length = norm(vector)
    return [arb(x) / length for x in vector]


def multiply(p: Quaternion, q: Quaternion) -> Quaternion:
    """Hamilton product."""
    return [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]


def measure_turn(p: Quaternion, q: Quaternion) -> arb:
    """Twice the angle on S³ between unit quaternions: 2π between q and -q."""
    apart = norm([a - b for a, b in zip(p, q, strict=True)])
    together = norm([a + b for a, b in zip(p, q, strict=True)])
    return 2 * 2 * arb.atan2(apart, together)


def find_long_vectors(motion: Motion) -> list[str]:
    """P1: quaternions and axes that are not of length 1."""
    found = []
    for segment in motion.segments:
        keys = ("start", "end", "axis") if segment.moves else ("orientation",)
        for key in keys:
            error = abs(norm(read_all(segment.data[key])) - 1)
            if surely_exceeds(error, UNIT):
                found.append(f"P1 {key} of {segment.place} is off unit length by {show(error)}")
    return found


def lead(segment: Segment) -> Quaternion:
    """Where an arc's start, axis and angle lead."""
    half = arb(read(segment.data["angle"])) / 2
    axis = normalise(segment.axis)
    turned = [half.cos(), *(half.sin() * x for x in axis)]
    return multiply(normalise(read_all(segment.data["start"])), turned)


def measure_arc(segment: Segment) -> arb:
    """An arc's own error E [rad]: at its start, between its pieces, at its end, and from its angle to `end`."""
    pieces = segment.pieces
    own = abs(pieces[0].first(0)) + abs(pieces[-1].last(0) - read(segment.data["angle"]))
    own += sum((abs(b.first(0) - a.last(0)) for a, b in pairwise(pieces)), own * 0)
    return arb(own) + measure_turn(lead(segment), normalise(read_all(segment.data["end"])))


def list_visits(motion: Motion) -> Iterator[tuple[str, list[Quaternion], arb]]:
    """Each visit of a node: what it is called, its stored quaternions in order, and the error brought to it.

    A visit is an arc's end, the dwells after it, and the next arc's start; the first begins and the last
    ends without an arc.
    """
    visit: list[Quaternion] = []
    error = arb(0)
    for segment in motion.segments:
        if not segment.moves:
            visit.append(normalise(read_all(segment.data["orientation"])))
            continue
        visit.append(normalise(read_all(segment.data["start"])))
        yield f"node before {segment.place}", visit, error + abs(segment.pieces[0].first(0))
        visit, error = [normalise(read_all(segment.data["end"]))], measure_arc(segment)
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
