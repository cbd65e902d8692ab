"""What a segment of the motion answers for: each kind is a file of its own, listed in `kinds`."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol, Self

import numpy as np

from timelaw.easing.profile import Side
from timelaw.limits import BoundRow, Bounds, Limit
from timelaw.limits.formula import Vector
from timelaw.limits.row_peaks import RowPeak
from timelaw.motion.schema import Part
from timelaw.numerics.array import Array
from timelaw.numerics.extrema import Peak
from timelaw.numerics.function import Function, enclose_peaks

RATES = {1: "omega", 2: "alpha", 3: "jerk", 4: "snap"}
MAX_ORDER = max(RATES)  # q, ω, α, jerk and snap are what a law is evaluated for


@dataclass(frozen=True)
class Quantity:
    """What a row limits on one piece of a segment: |value| ≤ row.bound for τ from `start` to `end`."""

    row: BoundRow
    value: Function
    start: float
    end: float


@dataclass(frozen=True)
class Edges:
    """What of ω, α, jerk and snap of one segment says how they join, and by what a jump is judged.

    `sides` (4, 2, 3) at its first and last instant, from inside; `jumps` (4, p-1, 3) at the breaks inside;
    `sums` (4,) are ∫ |rate| dt over it, or a little more: of root mean squares where there are no spikes.
    """

    sides: Array
    jumps: Array
    sums: Array


@dataclass(frozen=True)
class Discrepancy:
    """How far a segment is from what it should be in one respect, and what is tolerated."""

    check: str
    error: float
    tolerance: float


class Segment(Protocol):
    """A part of the motion between two instants; τ ∈ [0, 1] is the part of its duration that has passed.

    Orientations are unit quaternions (4,), rates (3,) in body axes; `side` says from where a break is
    looked at, `end` is 0 for the first instant and -1 for the last. A segment that `moves` the
    body is a leg. `limits` hold on this segment besides those of the law; `own_limits` are keys that only
    its kind knows. What a proof needs of all segments it asks their kinds, which may answer for many at once.
    """

    kind: ClassVar[str]
    moves: ClassVar[bool]
    own_limits: ClassVar[tuple[str, ...]]
    document_model: ClassVar[type[Part]]

    @property
    def name(self) -> str:
        """How reports call it."""
        ...

    @property
    def fineness(self) -> float:
        """2 n p of p pieces of quaternions of degree n, whose rounding its rates show; 0 without."""
        ...

    @property
    def origin(self) -> str:
        """Label of the node where it begins."""
        ...

    @property
    def target(self) -> str:
        """Label of the node where it ends."""
        ...

    @property
    def start_time(self) -> float:
        """First instant [s]."""
        ...

    @property
    def end_time(self) -> float:
        """Last instant [s]."""
        ...

    @property
    def duration(self) -> float:
        """Time between them [s]."""
        ...

    @property
    def start(self) -> Array:
        """Orientation at the first instant."""
        ...

    @property
    def end(self) -> Array:
        """Orientation that it should end in."""
        ...

    @property
    def breaks(self) -> Array:
        """Where its pieces meet (p+1,), in τ."""
        ...

    @property
    def even_breaks(self) -> Array:
        """The same and more (n+1,), so close that nothing on the parts between them is a spike of |Q|²."""
        ...

    @property
    def limits(self) -> Mapping[str, Bounds]:
        """Bounds of this segment alone, in SI."""
        ...

    @property
    def travels(self) -> bool:
        """Whether it says where the body's origin is."""
        ...

    def __call__(self, tau: Array, order: int, side: Side) -> Array:
        """At τ (m,): quaternions (m, 4) for order 0, else ω, α, jerk, snap (m, 3)."""
        ...

    def place(self, tau: Array, order: int, side: Side) -> Array:
        """At τ (m,) the origin's place in the world, or a derivative of it in time (m, 3), if it travels."""
        ...

    def axis_at(self, end: int) -> Array | None:
        """The unit axis (3,) it turns about there; None where it does not turn."""
        ...

    @classmethod
    def integrate_squares(cls, segments: Sequence[Self], order: int) -> float:
        """∫ |k-th rate|² dt over many segments of the kind."""
        ...

    @classmethod
    def list_edges(cls, segments: Sequence[Self]) -> list[Edges]:
        """The edges of each of many segments of the kind."""
        ...

    @classmethod
    def find_largest(cls, segments: Sequence[Self]) -> Array:
        """The largest |ω|, |α|, |jerk|, |snap| (4,) in many segments of the kind."""
        ...

    @classmethod
    def find_peaks(
        cls, segments: Sequence[Self], limits: Sequence[Sequence[Limit]], total: Vector
    ) -> list[list[RowPeak]]:
        """Where each of many segments comes nearest to its limits; `total` is H (3,) in the world."""
        ...

    @classmethod
    def find_own_peaks(cls, segments: Sequence[Self]) -> list[list[RowPeak]]:
        """The same of those of its own limits that only its kind knows."""
        ...

    def list_deviations(self, bound: float = ...) -> Iterator[Quantity]:
        """The angle [rad] of the body to the arc from `start` to `end`, where it may leave it."""
        ...

    def unit_vectors(self) -> Iterable[Array]:
        """Its quaternions and axes, whose norm must be one."""
        ...

    def start_error(self) -> float:
        """Body rotation [rad] from `start` to where it begins."""
        ...

    def end_error(self) -> float:
        """Body rotation [rad] by which it misses `end`, all its own jumps of orientation added up."""
        ...

    def own_checks(self) -> Iterator[Discrepancy]:
        """What else must be true of this kind."""
        ...

    def stretched(self, factor: float, start_time: float) -> Self:
        """The same motion `factor` times as slow, from `start_time` [s]; a rest lasts as long as it did."""
        ...

    def document(self) -> dict[str, Any]:
        """As the law file has it."""
        ...

    @classmethod
    def read(cls, document: Any) -> Self:
        """From what `document_model` has checked."""
        ...


def group_by_kind(segments: Sequence[Segment]) -> Mapping[type[Segment], list[int]]:
    """The numbers of the segments of each kind that is there."""
    found: dict[type[Segment], list[int]] = defaultdict(list)
    for number, segment in enumerate(segments):
        found[type(segment)].append(number)
    return found


def enclose_quantities(found: Sequence[Sequence[Quantity]]) -> list[list[RowPeak]]:
    """The peaks of each segment's rows, those of one label joined; all are enclosed together."""
    tops = iter(enclose_peaks([quantity.value for own in found for quantity in own]))
    joined = []
    for own in found:
        places: dict[str, list[tuple[Quantity, Peak]]] = {}
        for quantity in own:
            places.setdefault(quantity.row.label, []).append((quantity, next(tops)))
        joined.append([_join(parts) for parts in places.values()])
    return joined


def _join(parts: Sequence[tuple[Quantity, Peak]]) -> RowPeak:
    """Of pieces the first that reaches the highest."""
    quantity, top = max(parts, key=lambda part: part[1].lower)
    # NumPy's maximum of what is not a number is not a number
    upper = float(np.max([peak.upper for _, peak in parts]))
    at = quantity.start + top.at * (quantity.end - quantity.start)
    return RowPeak(quantity.row, top.lower, upper, float(at))
