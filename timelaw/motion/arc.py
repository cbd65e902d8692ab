"""Segments of kind `arc`: a great-circle arc run through by an easing."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field, model_validator

from timelaw.easing import Easing, Timing
from timelaw.easing.easing import Side
from timelaw.limits import Bounds, Limit, list_rows
from timelaw.limits.bounds import read_bounds, write_bounds
from timelaw.limits.polynomials import expand_rows
from timelaw.motion.schema import (
    LARGEST_ANGLE,
    NARROWEST,
    BoundsDocument,
    Control,
    Duration,
    Number,
    Part,
    Vector3,
    Vector4,
)
from timelaw.motion.segment import RATES, Discrepancy, Quantity
from timelaw.numerics.array import Array
from timelaw.numerics.polynomial import Polynomial
from timelaw.numerics.quaternion import from_axis_angle, multiply

EASING_TOLERANCE = 1e-12  # of the leg; intervals of an easing share their end points


class EasingDocument(Part):
    """Bernstein control points of f on each interval of `breaks` ⊂ [0, 1]."""

    breaks: Annotated[list[Number], Field(min_length=2)]
    bernstein: Annotated[
        list[Annotated[list[Control], Field(min_length=2, max_length=64)]], Field(min_length=1)
    ]

    @model_validator(mode="after")
    def _intervals(self) -> "EasingDocument":
        ascending = all(b - a >= NARROWEST for a, b in pairwise(self.breaks))
        if self.breaks[0] != 0 or self.breaks[-1] != 1 or not ascending:
            raise ValueError("breaks must ascend from 0 to 1")
        if len(self.bernstein) != len(self.breaks) - 1:
            raise ValueError(f"{len(self.breaks) - 1} intervals need as many lists of control points")
        return self


class ArcDocument(Part):
    """What a law file says of an arc."""

    kind: Literal["arc"]
    origin: Annotated[str, Field(alias="from")]
    target: Annotated[str, Field(alias="to")]
    start_time: Number
    duration: Duration
    start: Vector4
    end: Vector4
    axis: Vector3
    angle: Annotated[float, Field(ge=NARROWEST, le=LARGEST_ANGLE)]
    easing: EasingDocument
    limits: BoundsDocument = Field(default_factory=dict)


@dataclass(frozen=True)
class Arc:
    """q = q_i ⊗ (cos(fθ/2), n sin(fθ/2)), f = easing((t - start_time)/duration).

    `start`, `end` (4,) and the unit `axis` n (3,), in body axes, are kept as they were given:
    whether they agree with `angle` θ [rad] is for the certificate to say. `limits` hold on this
    segment besides those of the law.
    """

    kind: ClassVar[str] = "arc"
    moves: ClassVar[bool] = True
    document_model: ClassVar[type[Part]] = ArcDocument

    origin: str
    target: str
    start_time: float
    duration: float
    start: Array
    end: Array
    axis: Array
    angle: float
    easing: Easing
    limits: Mapping[str, Bounds] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """How reports call the segment."""
        return f"{self.origin}–{self.target}"

    @property
    def end_time(self) -> float:
        """Instant [s] at which the segment ends."""
        return self.start_time + self.duration

    @property
    def breaks(self) -> Array:
        """Breaks of the easing (p+1,) ⊂ [0, 1]."""
        return self.easing.breaks

    def __call__(self, tau: Array, order: int, side: Side) -> Array:
        """At τ (m,): quaternions (m, 4) for order 0, else ω, α, jerk, snap (m, 3) for 1 to 4."""
        f = self.easing(tau, order, side)
        if order == 0:
            return multiply(self.start, from_axis_angle(self.axis, self.angle * f))
        return np.array((self.angle / self.duration**order * f)[..., None] * self.axis)

    def axis_at(self, end: int) -> Array:  # noqa: ARG002
        """The same axis all along."""
        return self.axis

    def rates(self, order: int) -> list[Polynomial]:
        """The k-th time derivative of the travelled angle, a polynomial on each interval."""
        return Timing(self.duration, self.easing).rates(self.angle, order)

    def side(self, order: int, end: int) -> Array:
        """The k-th rate (3,) at the first (0) or last (-1) instant, from inside."""
        return np.array(self.rates(order)[end].control[end] * self.axis)

    def jumps(self) -> Iterator[dict[int, float]]:
        """Jumps of the travelled angle's rates at the breaks of the easing."""
        rates = {k: self.rates(k) for k in RATES}
        for left, right in pairwise(range(len(self.breaks) - 1)):
            yield {k: abs(float(r[right].control[0] - r[left].control[-1])) for k, r in rates.items()}

    def quantities(self, limits: Sequence[Limit]) -> Iterator[Quantity]:
        """Rows about the axis, as polynomials in time on each interval."""
        breaks = self.breaks.tolist()
        for row, piece, polynomial in expand_rows(list_rows(limits, self.axis), self.rates):
            yield Quantity(row, polynomial, breaks[piece], breaks[piece + 1])

    def unit_vectors(self) -> tuple[Array, ...]:
        """Both orientations, and the axis."""
        return self.start, self.end, self.axis

    def end_error(self) -> float:
        """Distance on S³ between where the arc leads and the quaternion it says it reaches, sign included."""
        led = multiply(self.start, from_axis_angle(self.axis, np.array(self.angle)))
        return float(np.linalg.norm(led - self.end))

    def own_checks(self) -> Iterator[Discrepancy]:
        """How far f is from 0 at the start, from 1 at the end, and from itself at the breaks."""
        pieces = self.easing.pieces
        gaps = [abs(float(b[0] - a[-1])) for a, b in pairwise(pieces)]
        error = max([abs(float(pieces[0][0])), abs(float(pieces[-1][-1]) - 1), *gaps])
        yield Discrepancy("easings run from 0 to 1", error, EASING_TOLERANCE)

    def document(self) -> dict[str, Any]:
        """As the law file has it."""
        own = {"limits": write_bounds(self.limits)} if self.limits else {}
        return {
            "kind": self.kind,
            "from": self.origin,
            "to": self.target,
            "start_time": self.start_time,
            "duration": self.duration,
            "start": self.start.tolist(),
            "end": self.end.tolist(),
            "axis": self.axis.tolist(),
            "angle": self.angle,
            **own,
            "easing": {
                "breaks": self.easing.breaks.tolist(),
                "bernstein": [piece.tolist() for piece in self.easing.pieces],
            },
        }

    @classmethod
    def read(cls, s: ArcDocument) -> "Arc":
        """From the law file; numbers are taken bit for bit."""
        pieces = tuple(np.array(c, dtype=float) for c in s.easing.bernstein)
        easing = Easing(np.array(s.easing.breaks, dtype=float), pieces)
        start, end, axis = (np.array(v, dtype=float) for v in (s.start, s.end, s.axis))
        limits = read_bounds(s.limits)
        return cls(s.origin, s.target, s.start_time, s.duration, start, end, axis, s.angle, easing, limits)
