"""Segments of kind `rational`: the orientation is Q/|Q|, Q a quaternion polynomial in time on each piece.

The body's origin may move with it, along P/|Q|², P a polynomial too.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import pairwise
from math import fsum
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from timelaw.easing.profile import Side, locate
from timelaw.limits import Bounds, Limit
from timelaw.limits.bounds import read_bounds
from timelaw.limits.formula import LINEAR, Vector, dot
from timelaw.limits.row import FormulaRow
from timelaw.motion.deviation import DEVIATION, list_deviations
from timelaw.motion.moving import LegDocument, Moving
from timelaw.motion.origin_curve import OriginCurve
from timelaw.motion.quaternion_curve import QuaternionCurve
from timelaw.motion.schema import BRIEFEST, LONGEST, Part
from timelaw.motion.segment import Discrepancy, Quantity
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import rotation_between
from timelaw.numerics.quotient import Quotient

QUADRATURE = 24  # nodes
WEIGHT = 1e6  # largest component of a control point: gauges near one, far from where squares overflow
FARTHEST = 1e12  # m
MOST_CONTROL, MOST_POINTS = 64, 200  # of a piece: degree 63, as far as easings and their paths get together
HIGHEST_LIMITED = 2  # derivative of the origin's place that a limit may bound
ControlPoint = Annotated[
    list[Annotated[float, Field(ge=-WEIGHT, le=WEIGHT)]], Field(min_length=4, max_length=4)
]


Point = Annotated[list[Annotated[float, Field(ge=-FARTHEST, le=FARTHEST)]], Field(min_length=3, max_length=3)]


class CurveDocument(Part):
    """Duration [s], control points of Q over it, and with a translation those of P [m]."""

    duration: Annotated[float, Field(ge=BRIEFEST, le=LONGEST)]
    control: Annotated[list[ControlPoint], Field(min_length=2, max_length=MOST_CONTROL)]
    points: Annotated[list[Point], Field(min_length=1, max_length=MOST_POINTS)] | None = None


class RationalDocument(LegDocument):
    """What a law file says of a rational segment."""

    kind: Literal["rational"]
    pieces: Annotated[list[CurveDocument], Field(min_length=1)]

    @model_validator(mode="after")
    def _all_travel(self) -> Self:
        if len({piece.points is None for piece in self.pieces}) > 1:
            raise ValueError("points belong to all pieces of a segment, or to none")
        return self


@cache
def _quadrature() -> tuple[Array, Array]:
    """Gauss-Legendre nodes and weights on [0, 1]: for means that judge jumps, and prove nothing."""
    nodes, weights = np.polynomial.legendre.leggauss(QUADRATURE)
    return (nodes + 1) / 2, weights / 2


@dataclass(frozen=True)
class Rational(Moving):
    """q(t) = Q/|Q|, Q(t) by `pieces` that follow each other, each over its own duration.

    `origins` are the paths of the body's origin on these pieces, none for a body that only turns.
    `start` and `end` (4,) are the nodes it should lead from and to; whether it does is for the certificate to
    say. `limits` hold on this segment besides those of the law.
    """

    kind: ClassVar[str] = "rational"
    moves: ClassVar[bool] = True
    own_limits: ClassVar[tuple[str, ...]] = (DEVIATION,)
    document_model: ClassVar[type[Part]] = RationalDocument

    origin: str
    target: str
    start_time: float
    duration: float
    start: Array
    end: Array
    pieces: tuple[QuaternionCurve, ...]
    limits: Mapping[str, Bounds] = field(default_factory=dict)
    origins: tuple[OriginCurve, ...] = ()

    @property
    def travels(self) -> bool:
        """Whether it says where the origin is."""
        return bool(self.origins)

    @cached_property
    def breaks(self) -> Array:
        """Where the pieces meet (p+1,), in τ."""
        times = np.concatenate([[0.0], np.cumsum([piece.duration for piece in self.pieces])])
        breaks = times / times[-1]
        breaks[-1] = 1.0
        return np.array(breaks)

    def __call__(self, tau: Array, order: int, side: Side) -> Array:
        """At τ (m,): quaternions (m, 4) for order 0, else ω, α, jerk, snap (m, 3) for 1 to 4."""
        return self._evaluate(self.pieces, tau, order, side, 4 if order == 0 else 3)

    def place(self, tau: Array, order: int, side: Side) -> Array:
        """At τ (m,) the origin's place, velocity, acceleration, jerk (m, 3) in the world."""
        if not self.origins:
            return super().place(tau, order, side)
        return self._evaluate(self.origins, tau, order, side, 3)

    def _evaluate(
        self, pieces: Sequence[Callable[[Array, int], Array]], tau: Array, order: int, side: Side, width: int
    ) -> Array:
        tau = np.asarray(tau, dtype=float)
        index = locate(self.breaks, tau, side)
        value = np.empty((*tau.shape, width))
        for k in np.unique(index):
            here = index == k
            first, long = self.breaks[k], self.breaks[k + 1] - self.breaks[k]
            # the last piece may be shorter than times are told apart
            part = (tau[here] - first) / long if long else np.ones(np.count_nonzero(here))
            value[here] = pieces[k](np.clip(part, 0.0, 1.0), order)
        return value

    def axis_at(self, end: int) -> None:  # noqa: ARG002
        """It turns about another axis at every instant."""
        return

    def rates(self, order: int) -> list[Quotient]:
        """The size of the k-th rate on each piece: √(X_k·X_k/(hD)^2k)."""
        found = []
        for piece in self.pieces:
            numerator = piece.form.numerators(order)[order]
            found.append(Quotient(dot(numerator, numerator), piece.form.power(2 * order), 2))
        return found

    def side(self, order: int, end: int) -> Array:
        """The k-th rate (3,) at the first (0) or last (-1) instant, from inside."""
        return np.array(self.pieces[end](np.array([0.0 if end == 0 else 1.0]), order)[0])

    def jumps(self, order: int) -> Array:
        """Jumps (p-1, 3) of the k-th rate where pieces meet."""
        ends = np.array([0.0, 1.0])
        values = [piece(ends, order) for piece in self.pieces]
        return np.array([b[0] - a[1] for a, b in pairwise(values)]).reshape(-1, 3)

    def sum_rate(self, order: int) -> float:
        """∫ |k-th rate| dt, by quadrature on parts where D is even: no spike stands for all of its piece."""
        nodes, weights = _quadrature()
        terms = []
        for piece in self.pieces:
            for form in piece.forms:
                width = form.end - form.start
                sizes = np.linalg.norm(piece(form.start + width * nodes, order), axis=-1)
                terms.append(piece.duration * width * float(weights @ sizes))
        return fsum(terms)

    def quantities(self, limits: Sequence[Limit], total: Vector) -> Iterator[Quantity]:
        """Every limit's own formula in the numerators, over hD to the limit's power of time."""
        highest = max((limit.highest for limit in limits), default=1)
        breaks = zip(self.breaks[:-1], np.diff(self.breaks), strict=True)
        for index, (piece, (first, width)) in enumerate(zip(self.pieces, breaks, strict=True)):
            for form in piece.forms:
                rates, seen = form.numerators(highest), form.turn_back(total)
                if self.origins:
                    moved = self.origins[index].numerators(form, HIGHEST_LIMITED)
                    rates |= {LINEAR[order]: vector for order, vector in moved.items()}
                start, end = (float(first + width * u) for u in (form.start, form.end))
                for limit in limits:
                    for formula in limit.of(rates, seen):
                        row = FormulaRow(limit.name, formula, limit.unit, limit.highest)
                        value = Quotient(formula.value, form.power(limit.depth * formula.root))
                        yield Quantity(row, value, start, end)

    def own_quantities(self) -> Iterator[Quantity]:
        """How far it leaves the arc of its leg, where that is limited."""
        bound = self.limits.get(DEVIATION)
        if isinstance(bound, float):
            yield from self.list_deviations(bound)

    def list_deviations(self, bound: float = np.pi) -> Iterator[Quantity]:
        """The angle [rad] of the body to the arc from `start` to `end`, part by part."""
        yield from list_deviations(self.start, self.end, self.pieces, self.breaks.tolist(), bound)

    def unit_vectors(self) -> tuple[Array, ...]:
        """Both orientations."""
        return self.start, self.end

    def start_error(self) -> float:
        """Body rotation [rad] from `start` to where it begins."""
        return rotation_between(self.start, self.pieces[0].control[0])

    def end_error(self) -> float:
        """Body rotation [rad] by which it misses `start`, `end` and itself where pieces meet, added up."""
        ends = [(piece.control[0], piece.control[-1]) for piece in self.pieces]
        gaps = sum(rotation_between(a[1], b[0]) for a, b in pairwise(ends))
        return self.start_error() + gaps + rotation_between(ends[-1][1], self.end)

    def own_checks(self) -> Iterator[Discrepancy]:
        """Whether the pieces' durations add up."""
        yield self.check_filled(piece.duration for piece in self.pieces)

    def document(self) -> dict[str, Any]:
        """As the law file has it."""
        pieces = [{"duration": p.duration, "control": p.control.tolist()} for p in self.pieces]
        points = [{"points": origin.points.tolist()} for origin in self.origins] or [{}] * len(pieces)
        return self.write({}, [piece | own for piece, own in zip(pieces, points, strict=True)])

    @classmethod
    def read(cls, s: RationalDocument) -> "Rational":
        """From the law file; numbers are taken bit for bit."""
        pieces = tuple(QuaternionCurve(p.duration, np.array(p.control, dtype=float)) for p in s.pieces)
        start, end = (np.array(v, dtype=float) for v in (s.start, s.end))
        origins = tuple(
            OriginCurve(np.array(p.points, dtype=float), piece)
            for p, piece in zip(s.pieces, pieces, strict=True)
            if p.points is not None
        )
        limits = read_bounds(s.limits)
        return cls(s.origin, s.target, s.start_time, s.duration, start, end, pieces, limits, origins)
