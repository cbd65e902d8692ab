"""Segments of kind `rational`: the orientation is Q/|Q|, Q a quaternion polynomial in time on each piece.

The body's origin may move with it, along P/|Q|², P a polynomial too.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from math import fsum
from typing import Any, ClassVar

import numpy as np

from timelaw.easing.profile import Side, locate
from timelaw.limits import Bounds, Limit
from timelaw.limits.bounds import read_bounds
from timelaw.limits.formula import Vector
from timelaw.limits.row_peaks import RowPeak
from timelaw.motion.deviation import DEVIATION, DeviationRow, list_deviations
from timelaw.motion.moving import Moving
from timelaw.motion.origin_curve import OriginCurve
from timelaw.motion.quaternion_curve import QuaternionCurve, stack_curves
from timelaw.motion.rational_document import RationalDocument
from timelaw.motion.rational_quantities import list_quantities, number_pieces
from timelaw.motion.schema import Part
from timelaw.motion.segment import RATES, Discrepancy, Edges, Quantity, enclose_quantities
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import rotation_between
from timelaw.numerics.quotient import Quotient


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

    @property
    def fineness(self) -> float:
        """2 n p: its k-th power bounds the k-th derivative of p pieces of degree n, of size one."""
        return 2.0 * len(self.pieces) * max(len(piece.control) - 1 for piece in self.pieces)

    @cached_property
    def breaks(self) -> Array:
        """Where the pieces meet (p+1,), in τ."""
        times = np.concatenate([[0.0], np.cumsum([piece.duration for piece in self.pieces])])
        breaks = times / times[-1]
        breaks[-1] = 1.0
        return np.array(breaks)

    @cached_property
    def even_breaks(self) -> Array:
        """The same and those of the parts where D is even (n+1,), in τ."""
        found, long = [self.breaks], np.diff(self.breaks)
        for stack in stack_curves(self.pieces):
            form = stack.form.split()
            piece = stack.piece[form.piece]
            found.append(self.breaks[piece] + long[piece] * form.start)
        return np.unique(np.concatenate(found))

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

    @classmethod
    def integrate_squares(cls, segments: Sequence["Rational"], order: int) -> float:
        """By quadrature on each piece."""
        total = 0.0
        for stack in stack_curves([piece for s in segments for piece in s.pieces]):
            squares = [rate.integrate_square() for rate in stack.form.measure_rate(order)]
            total += float(stack.duration @ np.array(squares))
        return total

    @classmethod
    def list_edges(cls, segments: Sequence["Rational"]) -> list[Edges]:
        """From the rates at the ends of pieces, and their mean sizes."""
        pieces = [piece for s in segments for piece in s.pieces]
        ends, sums = np.empty((len(RATES), len(pieces), 2, 3)), np.empty((len(RATES), len(pieces)))
        for stack in stack_curves(pieces):
            ends[:, stack.piece], sums[:, stack.piece] = stack.find_ends(), stack.sum_rates()
        found = []
        for own in number_pieces(segments):
            jumps = ends[:, own][:, 1:, 0] - ends[:, own][:, :-1, 1]
            sides = np.stack([ends[:, own.start, 0], ends[:, own.stop - 1, 1]], axis=1)
            found.append(Edges(sides, jumps, np.array([fsum(terms) for terms in sums[:, own]])))
        return found

    @classmethod
    def find_largest(cls, segments: Sequence["Rational"]) -> Array:
        """Over the parts of all pieces where D is even."""
        largest = np.zeros(len(RATES))
        for stack in stack_curves([piece for s in segments for piece in s.pieces]):
            form = stack.form.split()
            for k, order in enumerate(RATES):
                largest[k] = max(largest[k], Quotient.find_largest(form.measure_rate(order)))
        return largest

    @classmethod
    def find_peaks(
        cls, segments: Sequence["Rational"], limits: Sequence[Sequence[Limit]], total: Vector
    ) -> list[list[RowPeak]]:
        """Those of every limit's own formula."""
        return enclose_quantities(list_quantities(segments, limits, total))

    @classmethod
    def find_own_peaks(cls, segments: Sequence["Rational"]) -> list[list[RowPeak]]:
        """How far each leaves the arc of its leg, where that is limited."""
        bounds = [s.limits.get(DEVIATION) for s in segments]
        limited = [
            list(s.list_deviations(bound)) if isinstance(bound, float) else []
            for s, bound in zip(segments, bounds, strict=True)
        ]
        return enclose_quantities(limited)

    def list_deviations(self, bound: float = np.pi) -> Iterator[Quantity]:
        """The angle [rad] of the body to the arc from `start` to `end`, part by part."""
        row = DeviationRow(bound)
        yield from (replace(part, row=row) for part in self._deviations)

    @cached_property
    def _deviations(self) -> tuple[Quantity, ...]:
        """Without a bound: proof, report and pictures ask for them, and cutting takes time."""
        return tuple(list_deviations(self.start, self.end, self.pieces, self.breaks.tolist(), np.pi))

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

    def stretched(self, factor: float, start_time: float) -> "Rational":
        """The same curve `factor` times as slow, from `start_time` [s]: its control points stay."""
        pieces = tuple(replace(piece, duration=piece.duration * factor) for piece in self.pieces)
        turned = zip(self.origins, pieces, strict=False)
        origins = tuple(replace(origin, turn=piece) for origin, piece in turned)
        duration = self.duration * factor
        return replace(self, start_time=start_time, duration=duration, pieces=pieces, origins=origins)

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
