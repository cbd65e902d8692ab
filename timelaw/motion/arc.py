"""Segments of kind `arc`: a great-circle arc run through by a profile of the angle travelled."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import FailFast, Field

from timelaw.easing.piece_stack import stack_profiles
from timelaw.easing.profile import Piece, Profile, Side
from timelaw.limits import Bounds, Limit, list_rows
from timelaw.limits.bounds import read_bounds
from timelaw.limits.formula import Vector
from timelaw.limits.row_peaks import RowPeak, enclose_rows
from timelaw.motion.arc_edges import (
    find_largest_rates,
    integrate_square_rates,
    join_angles,
    list_edges,
)
from timelaw.motion.moving import LegDocument, Moving
from timelaw.motion.schema import (
    BRIEFEST,
    LARGEST_ANGLE,
    LONGEST,
    NARROWEST,
    Control,
    Part,
    Vector3,
)
from timelaw.motion.segment import MAX_ORDER, Discrepancy, Edges, Quantity
from timelaw.numerics.array import Array
from timelaw.numerics.ball import enclose_direction
from timelaw.numerics.quaternion import from_axis_angle, multiply, normalise, rotation_between


class PieceDocument(Part):
    """Duration [s], φ and its first derivatives at the start, control points of the next derivative."""

    duration: Annotated[float, Field(ge=BRIEFEST, le=LONGEST)]
    state: Annotated[list[Control], Field(min_length=1, max_length=MAX_ORDER + 1)]
    bernstein: Annotated[list[Control], Field(min_length=1, max_length=64)]


class ArcDocument(LegDocument):
    """What a law file says of an arc."""

    kind: Literal["arc"]
    axis: Vector3
    angle: Annotated[float, Field(ge=NARROWEST, le=LARGEST_ANGLE)]
    pieces: Annotated[list[PieceDocument], Field(min_length=1), FailFast()]


@dataclass(frozen=True)
class Arc(Moving):
    """q = q_i ⊗ (cos(φ/2), n sin(φ/2)), φ(t) = profile((t - start_time)/duration) from 0 to θ.

    q_i and n are `start` (4,) and `axis` (3,), in body axes, each over its norm. They are kept as they were
    given, as is `end`: whether they agree with `angle` θ [rad] is for the certificate to say. `limits` hold
    on this segment besides those of the law.
    """

    kind: ClassVar[str] = "arc"
    moves: ClassVar[bool] = True
    fineness: ClassVar[float] = 0.0
    own_limits: ClassVar[tuple[str, ...]] = ()
    document_model: ClassVar[type[Part]] = ArcDocument

    origin: str
    target: str
    start_time: float
    duration: float
    start: Array
    end: Array
    axis: Array
    angle: float
    profile: Profile
    limits: Mapping[str, Bounds] = field(default_factory=dict)

    @cached_property
    def direction(self) -> Array:
        """The unit axis (3,)."""
        return normalise(self.axis)

    @cached_property
    def enclosed_axis(self) -> Array:
        """The same (3,) as balls, for proofs."""
        return enclose_direction(self.axis)

    @property
    def breaks(self) -> Array:
        """Where the pieces of the profile meet (p+1,), in τ."""
        return self.profile.breaks

    @property
    def even_breaks(self) -> Array:
        """Its breaks: nothing divides what it turns by."""
        return self.breaks

    def __call__(self, tau: Array, order: int, side: Side) -> Array:
        """At τ (m,): quaternions (m, 4) for order 0, else ω, α, jerk, snap (m, 3) for 1 to 4."""
        rate = self.profile(tau, order, side)
        if order == 0:
            return self._turn(rate)
        return np.array(rate[..., None] * self.direction)

    def _turn(self, angle: Array) -> Array:
        """The orientation (..., 4) after an angle (...)."""
        return multiply(normalise(self.start), from_axis_angle(self.direction, angle))

    def axis_at(self, end: int) -> Array:  # noqa: ARG002
        """The same axis all along."""
        return self.direction

    @classmethod
    def integrate_squares(cls, segments: Sequence["Arc"], order: int) -> float:
        """That of the k-th derivative of φ, exact but for rounding."""
        return integrate_square_rates([s.profile for s in segments], order)

    @classmethod
    def list_edges(cls, segments: Sequence["Arc"]) -> list[Edges]:
        """From the rates of φ."""
        directions = np.array([s.direction for s in segments])
        return list_edges([s.profile for s in segments], directions)

    @classmethod
    def find_largest(cls, segments: Sequence["Arc"]) -> Array:
        """Those of φ."""
        return find_largest_rates([s.profile for s in segments])

    @classmethod
    def find_peaks(
        cls,
        segments: Sequence["Arc"],
        limits: Sequence[Sequence[Limit]],
        total: Vector,  # noqa: ARG003
    ) -> list[list[RowPeak]]:
        """Those of rows about the axis, polynomials in time on each piece."""
        rows = [
            list_rows(own, s.enclosed_axis) if own else () for s, own in zip(segments, limits, strict=True)
        ]
        if not any(rows):
            return [[] for _ in segments]
        return enclose_rows(rows, stack_profiles([s.profile for s in segments]))

    @classmethod
    def find_own_peaks(cls, segments: Sequence["Arc"]) -> list[list[RowPeak]]:
        """None."""
        return [[] for _ in segments]

    def list_deviations(self, bound: float = 0.0) -> Iterator[Quantity]:  # noqa: ARG002
        """It stays on its arc."""
        yield from ()

    def unit_vectors(self) -> tuple[Array, ...]:
        """Both orientations, and the axis."""
        return self.start, self.end, self.axis

    def start_error(self) -> float:
        """|φ(0)| [rad]."""
        return abs(float(self.profile.pieces[0].state[0]))

    def end_error(self) -> float:
        """|φ(0)|, the gaps of φ between pieces, |φ - θ| at the end, and from where θ leads to `end` [rad]."""
        joined = join_angles(self.profile)
        missed = abs(joined.end - self.angle) + rotation_between(self._turn(np.array(self.angle)), self.end)
        return self.start_error() + joined.gaps + missed + 2 * joined.rounding

    def own_checks(self) -> Iterator[Discrepancy]:
        """Whether the pieces' durations add up."""
        yield self.check_filled(piece.duration for piece in self.profile.pieces)

    def stretched(self, factor: float, start_time: float) -> "Arc":
        """The same turn `factor` times as slow, from `start_time` [s]."""
        profile = self.profile.scaled(1.0, factor)
        return replace(self, start_time=start_time, duration=self.duration * factor, profile=profile)

    def document(self) -> dict[str, Any]:
        """As the law file has it."""
        pieces = [
            {"duration": p.duration, "state": p.state.tolist(), "bernstein": p.control.tolist()}
            for p in self.profile.pieces
        ]
        return self.write({"axis": self.axis.tolist(), "angle": self.angle}, pieces)

    @classmethod
    def read(cls, s: ArcDocument) -> "Arc":
        """From the law file; numbers are taken bit for bit."""
        pieces = (Piece(p.duration, np.array(p.state), np.array(p.bernstein)) for p in s.pieces)
        profile = Profile(tuple(pieces))
        start, end, axis = (np.array(v, dtype=float) for v in (s.start, s.end, s.axis))
        limits = read_bounds(s.limits)
        return cls(s.origin, s.target, s.start_time, s.duration, start, end, axis, s.angle, profile, limits)
