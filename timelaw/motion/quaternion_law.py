"""The motion of the body as a function of time: orientation, matrices, and rates in body axes."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from timelaw.easing.profile import Side, locate
from timelaw.limits import Bounds, make_limits
from timelaw.limits.body import RigidBody
from timelaw.limits.formula import Vector, product
from timelaw.limits.row_peaks import RowPeak
from timelaw.motion.segment import MAX_ORDER, Edges, Segment, group_by_kind
from timelaw.numerics.array import Array, freeze
from timelaw.numerics.ball import Ball, enclose_direction
from timelaw.numerics.quaternion import rotation_matrix

if TYPE_CHECKING:
    from timelaw.motion.evaluation import PieceTable


@dataclass(frozen=True)
class QuaternionLaw:
    """Segments that follow each other from t = 0.

    `limits` are the bounds the law is made for, in SI, the `body` is there where they need it,
    `continuity` k is the class C^k that was asked for. `before` and `after` are the rates (3,) by
    order with which the motion is entered and left; an order that is not there is zero. One that is
    `periodic` goes round: what comes before it is its own end, and what comes after it its start. `shape` are
    the edges [m] of the box that pictures show, centred at the body's origin.
    """

    name: str
    segments: tuple[Segment, ...]
    limits: Mapping[str, Bounds]
    body: RigidBody | None = None
    continuity: int = 0
    before: Mapping[int, Array] = field(default_factory=dict)
    after: Mapping[int, Array] = field(default_factory=dict)
    periodic: bool = False
    shape: tuple[float, float, float] | None = None

    @property
    def travels(self) -> bool:
        """Whether it says where the body's origin is."""
        return all(segment.travels for segment in self.segments)

    @cached_property
    def times(self) -> Array:
        """Start times of the segments and the end of the last (n+1,) [s]."""
        starts = [s.start_time for s in self.segments]
        return freeze(np.array([*starts, self.segments[-1].end_time]))

    @property
    def duration(self) -> float:
        """Total time [s]."""
        return self.segments[-1].end_time

    @cached_property
    def labels(self) -> tuple[str, ...]:
        """Labels of the nodes (n+1)."""
        return (self.segments[0].origin, *(s.target for s in self.segments))

    def __call__(self, t: ArrayLike, order: int = 0, side: Side = "right") -> Array:
        """Unit quaternions q (..., 4) for order 0; ω, α, jerk, snap (..., 3) in body axes for 1 to 4.

        At a node, or a break inside a segment, the value from the given side.

        Raises:
            ValueError: t (...) outside [0, duration], or an order other than 0 to 4.
        """
        return self.evaluate(t, (order,), side)[0]

    def evaluate(self, t: ArrayLike, orders: Sequence[int], side: Side = "right") -> tuple[Array, ...]:
        """What calls give for these orders, in one pass; memory is the results and a few thousand instants.

        Raises:
            ValueError: t (...) outside [0, duration], or an order other than 0 to 4.
        """
        for order in orders:
            if order not in range(MAX_ORDER + 1):
                raise ValueError(f"order {order}; 0 (q), 1 (ω), 2 (α), 3 (jerk) or 4 (snap) is needed")
        t = np.asarray(t, dtype=float)
        values = self._pieces.evaluate(t.reshape(-1), orders, side)
        return tuple(values[order].reshape(*t.shape, 3 if order else 4) for order in orders)

    @cached_property
    def _pieces(self) -> "PieceTable":
        from timelaw.motion.evaluation import PieceTable  # a proof needs no values

        return PieceTable.of(self.segments)

    def place(self, t: ArrayLike, order: int = 0, side: Side = "right") -> Array:
        """The origin's place, velocity, acceleration, jerk (..., 3) [m, s] in the world for order 0 to 3.

        Raises:
            ValueError: t (...) outside [0, duration], or the motion has no translation.
        """
        t = np.asarray(t, dtype=float)
        value = np.empty((*t.shape, 3))
        for segment, here, tau in self._find(t, side):
            value[here] = segment.place(tau, order, side)
        return value

    def _find(self, t: Array, side: Side) -> Iterator[tuple[Segment, Array, Array]]:
        """Segments, which of the times (...) are theirs, and the τ of these."""
        index = locate(self.times, t, side)
        for k in np.unique(index):
            here = index == k
            segment = self.segments[k]
            tau = np.clip((t[here] - segment.start_time) / segment.duration, 0.0, 1.0)
            # the last piece may be shorter than times are told apart
            yield segment, here, np.where(t[here] >= self.times[k + 1], 1.0, tau)

    def rotation(self, t: ArrayLike) -> Array:
        """R(t) (..., 3, 3): r_world = R r_body [MMB2017]."""
        return rotation_matrix(self(t))

    def direction_cosines(self, t: ArrayLike) -> Array:
        """Q(t) = R(t)ᵀ (..., 3, 3): its rows are the body axes in world coordinates [MMB2017]."""
        return np.swapaxes(self.rotation(t), -1, -2)

    @property
    def legs(self) -> tuple[Segment, ...]:
        """The segments that move the body, in order."""
        return tuple(segment for segment in self.segments if segment.moves)

    @cached_property
    def total_momentum(self) -> Vector:
        """H (3,) [N·m·s] in the world, as balls: the body's at t = 0, turned by the first orientation."""
        if self.body is None or not self.body.total_momentum:
            return (0.0, 0.0, 0.0)
        turn = list(enclose_direction(self.segments[0].start))
        inner = [Ball(0.0), *map(Ball, self.body.momentum.tolist())]
        back = [turn[0], *(-part for part in turn[1:])]
        return product(product(turn, inner), back)[1:]

    def outside(self, order: int, end: int) -> Array:
        """The k-th rate (3,) before its start (0) or after its end (-1)."""
        if self.periodic:
            edges = self.edges[-1 if end == 0 else 0]
            return np.array(edges.sides[order - 1, -1 if end == 0 else 0])
        return (self.before if end == 0 else self.after).get(order, np.zeros(3))

    @cached_property
    def edges(self) -> tuple[Edges, ...]:
        """The rates at the edges of each segment."""
        found: dict[int, Edges] = {}
        for kind, numbers in group_by_kind(self.segments).items():
            edges = kind.list_edges([self.segments[k] for k in numbers])
            found.update(zip(numbers, edges, strict=True))
        return tuple(found[k] for k in range(len(self.segments)))

    def find_largest(self) -> Array:
        """The largest |ω|, |α|, |jerk|, |snap| (4,) of the motion."""
        kinds = group_by_kind(self.segments).items()
        found = [kind.find_largest([self.segments[k] for k in numbers]) for kind, numbers in kinds]
        return np.asarray(np.max(found, axis=0))

    def find_peaks(self) -> list[list[tuple[str, RowPeak]]]:
        """Where each segment comes nearest to its limits; a label names a limit of that segment alone so."""
        found: list[list[tuple[str, RowPeak]]] = [[] for _ in self.segments]
        general = make_limits(self.limits, self.body)
        for kind, numbers in group_by_kind(self.segments).items():
            members = [self.segments[k] for k in numbers]
            own = [make_limits(segment.limits, self.body) for segment in members]
            for peaks, place in (
                (kind.find_peaks(members, [general] * len(members), self.total_momentum), ""),
                (kind.find_peaks(members, own, self.total_momentum), " on {}"),
                (kind.find_own_peaks(members), ""),
            ):
                for k, rows in zip(numbers, peaks, strict=True):
                    suffix = place.format(self.segments[k].name)
                    found[k] += [(peak.row.label + suffix, peak) for peak in rows]
        return found
