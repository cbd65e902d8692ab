"""Does the law meet its nodes? Arcs, unit vectors and times, from the numbers in the law."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.arc import Arc
from timelaw.numerics.quaternion import from_axis_angle, multiply

UNIT_TOLERANCE = 1e-9  # |norm - 1|
NODE_TOLERANCE = 1e-9  # rad; a few hundred rounding errors of a product of quaternions
TIME_TOLERANCE = 1e-12  # of the total time; start times are sums of durations
EASING_TOLERANCE = 1e-12  # of the leg; intervals of an easing share their end points


@dataclass(frozen=True)
class GeometryCheck:
    """The worst of one kind of discrepancy, where it is, and what is tolerated."""

    check: str
    worst: float
    tolerance: float
    where: str

    @property
    def holds(self) -> bool:
        """Whether the worst is tolerable; not a number never is."""
        return self.worst <= self.tolerance


def check_geometry(law: QuaternionLaw) -> tuple[GeometryCheck, ...]:
    """Unit vectors, arcs that end where they say, segments that join, times that add up, easings 0 to 1."""
    segments, total = law.segments, law.duration
    return (
        _worst("unit quaternions and axes", UNIT_TOLERANCE, [(s.name, _unit_error(s)) for s in segments]),
        _worst(
            "arcs end at their nodes",
            NODE_TOLERANCE,
            [(s.name, _arc_error(s)) for s in segments if isinstance(s, Arc)],
        ),
        _worst("segments join", NODE_TOLERANCE, _joints(law)),
        _worst(
            "times add up",
            TIME_TOLERANCE * total,
            [(segments[0].name, abs(segments[0].start_time))]
            + [(b.name, abs(b.start_time - a.end_time)) for a, b in pairwise(segments)],
        ),
        _worst(
            "easings run from 0 to 1",
            EASING_TOLERANCE,
            [(s.name, _easing_error(s)) for s in segments if isinstance(s, Arc)],
        ),
    )


def _worst(check: str, tolerance: float, errors: list[tuple[str, float]]) -> GeometryCheck:
    if not errors:
        return GeometryCheck(check, 0.0, tolerance, "")
    where, worst = max(errors, key=lambda e: e[1] if e[1] == e[1] else np.inf)
    return GeometryCheck(check, worst, tolerance, where)


def _unit_error(s: Segment) -> float:
    vectors = (s.start, s.end, s.axis) if isinstance(s, Arc) else (s.orientation,)
    return max(abs(float(np.linalg.norm(v)) - 1) for v in vectors)


def _arc_error(s: Arc) -> float:
    """Distance on S³ between where the arc leads and the quaternion it says it reaches, sign included."""
    return float(np.linalg.norm(multiply(s.start, from_axis_angle(s.axis, np.array(s.angle))) - s.end))


def _joints(law: QuaternionLaw) -> list[tuple[str, float]]:
    """Distance on S³ at each joint, signs included, and infinite where the labels differ."""
    joints = [(law.segments[0].name, 0.0)]
    for a, b in pairwise(law.segments):
        same = a.target == b.origin
        joints.append((b.name, float(np.linalg.norm(a.end - b.start)) if same else float("inf")))
    return joints


def _easing_error(s: Arc) -> float:
    """How far f is from 0 at the start, from 1 at the end, and from itself at the breaks."""
    pieces = s.easing.pieces
    gaps = [abs(float(b[0] - a[-1])) for a, b in pairwise(pieces)]
    return max([abs(float(pieces[0][0])), abs(float(pieces[-1][-1]) - 1), *gaps])
