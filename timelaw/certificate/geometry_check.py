"""Does the law meet its nodes? Arcs, unit vectors and times, from the numbers in the law."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.segment import NODE_TOLERANCE

UNIT_TOLERANCE = 1e-9  # |norm - 1|
TIME_TOLERANCE = 1e-12  # of the total time; start times are sums of durations


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
    """Unit vectors, segments that end where they say and join, times that add up, what each kind asks for."""
    segments, total = law.segments, law.duration
    own: dict[str, list[tuple[str, float]]] = {}
    tolerances: dict[str, float] = {}
    for s in segments:
        for found in s.own_checks():
            own.setdefault(found.check, []).append((s.name, found.error))
            tolerances[found.check] = found.tolerance
    return (
        _worst("unit quaternions and axes", UNIT_TOLERANCE, [(s.name, _unit_error(s)) for s in segments]),
        _worst("arcs end at their nodes", NODE_TOLERANCE, [(s.name, s.end_error()) for s in segments]),
        _worst("segments join", NODE_TOLERANCE, _joints(law)),
        _worst(
            "times add up",
            TIME_TOLERANCE * total,
            [(segments[0].name, abs(segments[0].start_time))]
            + [(b.name, abs(b.start_time - a.end_time)) for a, b in pairwise(segments)],
        ),
        *(_worst(check, tolerances[check], errors) for check, errors in own.items()),
    )


def _worst(check: str, tolerance: float, errors: list[tuple[str, float]]) -> GeometryCheck:
    where, worst = max(errors, key=lambda e: e[1] if e[1] == e[1] else np.inf)
    return GeometryCheck(check, worst, tolerance, where)


def _unit_error(s: Segment) -> float:
    return max(abs(float(np.linalg.norm(v)) - 1) for v in s.unit_vectors())


def _joints(law: QuaternionLaw) -> list[tuple[str, float]]:
    """Distance on S³ at each joint, signs included, and infinite where the labels differ."""
    joints = [(law.segments[0].name, 0.0)]
    for a, b in pairwise(law.segments):
        same = a.target == b.origin
        joints.append((b.name, float(np.linalg.norm(a.end - b.start)) if same else float("inf")))
    return joints
