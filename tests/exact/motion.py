"""A law document in exact numbers: its segments, limits and body, whatever is promised of them."""

from collections.abc import Hashable
from functools import cached_property
from typing import Any

from flint import arb, fmpq

from tests.exact.quaternions import multiply
from tests.exact.rational import Vector, apply, cross, dot, read_all
from tests.exact.rational_segment import RationalSegment
from tests.exact.segments import ORDERS, Arc, Segment

RATES = dict(zip(ORDERS, ("omega", "alpha", "jerk", "snap"), strict=True))
KINDS = {"arc": Arc, "dwell": Segment, "rational": RationalSegment}


class Motion:
    """The whole document: `segments`, `limits`, the body's inertia (3, 3) and its momentum."""

    def __init__(self, document: dict[str, Any]):
        self.document = document
        self.segments = [KINDS[data["kind"]](data, index) for index, data in enumerate(document["segments"])]
        self.limits: dict[str, Any] = document["limits"]
        body = document.get("body") or {}
        self.inertia = [read_all(row) for row in body["inertia"]] if body else None
        self.wheels = body.get("actuator") == "wheels"
        self.momentum = read_all(body.get("momentum", [0, 0, 0]))

    @property
    def moving(self) -> list[Segment]:
        """The segments that turn the body."""
        return [segment for segment in self.segments if segment.moves]

    @property
    def mean_time(self) -> fmpq:
        """Of a segment that turns the body."""
        return sum((segment.duration for segment in self.moving), fmpq(0)) / len(self.moving)

    @property
    def end(self) -> fmpq:
        """The end of the last segment."""
        return self.segments[-1].begins + self.segments[-1].duration

    @property
    def periodic(self) -> bool:
        """Whether it goes round."""
        return bool(self.document.get("periodic"))

    @property
    def travels(self) -> bool:
        """Whether the body's origin moves."""
        return bool(self.moving) and all(getattr(segment, "origins", []) for segment in self.moving)

    def outside(self, side: str, order: int) -> list[arb]:
        """The rate vector before or after the motion: its own other end, of one that goes round."""
        if self.periodic:
            ends = self.segments[-1].last(order), self.segments[0].first(order)
            return [arb(x) for x in ends[0 if side == "before" else 1]]
        given = ((self.document.get("outside") or {}).get(side) or {}).get(RATES[order], [0, 0, 0])
        return [arb(x) for x in read_all(given)]

    def carry(self, segment: Arc) -> tuple[Vector, Vector]:
        """J a and a × J a of an arc's axis a as it is stored."""
        carried = apply(self.inertia, segment.axis)
        return carried, cross(segment.axis, carried)

    @cached_property
    def total(self) -> Vector:
        """H (3,) in the world: the momentum in body axes, turned by the first `start` over its length."""
        start = self.segments[0].start
        back = [start[0], *(-x for x in start[1:])]
        turned = multiply(multiply(start, [fmpq(0), *self.momentum]), back)[1:]
        return [x / dot(start, start) for x in turned]

    @cached_property
    def body(self) -> Hashable:
        """What tells bodies and momenta apart."""
        return tuple(map(tuple, self.inertia or [])), self.wheels, tuple(self.total)
