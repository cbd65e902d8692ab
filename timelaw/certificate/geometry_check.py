"""Does the law meet its nodes, in time? From the numbers in the law."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import inf

import numpy as np

from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.quaternion import rotation_between

UNIT_TOLERANCE = 1e-9  # |norm - 1|
NODE_TOLERANCE = 1e-9  # rad of body rotation, of all that comes together at a node
NODE_ROUNDING = 1e-14  # rad; of products of quaternions and their angles, a few dozen roundings
CLOCK_TOLERANCE = 2.0  # spacings of the doubles there; a start time is a rounded sum
CLOCK_RESOLUTION = 1e-6  # of a segment; what the spacing of doubles is at most at its end
COUNTLESS = 10**300  # spacings: beyond, no double can count them
RESOLVED = "the clock resolves each segment"


@dataclass(frozen=True)
class GeometryCheck:
    """The worst of one kind of discrepancy, where it is, what is tolerated, and of what."""

    check: str
    worst: float
    tolerance: float
    where: str
    unit: str = ""

    @property
    def holds(self) -> bool:
        """Whether the worst is tolerable; not a number never is."""
        return self.worst <= self.tolerance


def check_geometry(law: QuaternionLaw) -> tuple[GeometryCheck, ...]:
    """Unit vectors, nodes that are met, times that add up and can be told, what each kind asks for."""
    segments = law.segments
    own: dict[str, list[tuple[str, float]]] = {}
    tolerances: dict[str, float] = {}
    for s in segments:
        for found in s.own_checks():
            own.setdefault(found.check, []).append((s.name, found.error))
            tolerances[found.check] = found.tolerance
    steps = [(segments[0].name, 0.0 if segments[0].start_time == 0 else inf)]
    steps += [(b.name, _step(a, b)) for a, b in pairwise(segments)]
    told = [(s.name, float(np.spacing(s.end_time)) / s.duration) for s in segments]
    return (
        _worst("unit quaternions and axes", UNIT_TOLERANCE, [(s.name, _unit_error(s)) for s in segments]),
        _worst("nodes are met", NODE_TOLERANCE, list(_miss_nodes(law)), "rad of body rotation"),
        _worst("times add up", CLOCK_TOLERANCE, steps, "spacings of the clock"),
        _worst(RESOLVED, CLOCK_RESOLUTION, told, "of the segment"),
        *(_worst(check, tolerances[check], errors) for check, errors in own.items()),
    )


def _step(before: Segment, after: Segment) -> float:
    """The time between two segments in spacings of doubles there, exact: no gap may look like less."""
    gap = Fraction(after.start_time) - Fraction(before.start_time) - Fraction(before.duration)
    spacings = abs(gap) / Fraction(float(np.spacing(max(after.start_time, before.end_time))))
    return float(spacings) if spacings < COUNTLESS else inf


def _worst(check: str, tolerance: float, errors: list[tuple[str, float]], unit: str = "") -> GeometryCheck:
    where, worst = max(errors, key=lambda e: e[1] if e[1] == e[1] else np.inf)
    return GeometryCheck(check, float(worst), tolerance, where, unit)


def _unit_error(s: Segment) -> float:
    return max(abs(float(np.linalg.norm(v)) - 1) for v in s.unit_vectors())


def _miss_nodes(law: QuaternionLaw) -> Iterator[tuple[str, float]]:
    """For each node how far apart [rad] all is that should be there; infinite where labels differ.

    What the segment that comes there misses, the orientations that the file has for it (the segment's end,
    those of dwells, the next one's start), and how far from there the next one begins.
    """
    label, missed, there, apart = law.segments[0].origin, 0.0, law.segments[0].start, 0.0
    for segment in law.segments:
        apart = max(apart, rotation_between(there, segment.start))
        if segment.origin != label:
            apart = inf
        if segment.moves:
            yield f"node {label}", missed + apart + segment.start_error() + NODE_ROUNDING
            missed, there, apart = segment.end_error(), segment.end, 0.0
        label = segment.target
    round_ = 0.0
    if law.periodic:
        first = law.segments[0].start
        round_ = min(rotation_between(there, first), rotation_between(-there, first))
    yield f"node {label}", missed + apart + round_ + NODE_ROUNDING
