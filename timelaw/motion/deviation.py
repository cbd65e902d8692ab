"""How far a motion leaves the closed arc from node to node, as an angle of the body, proved.

Between the planes at right angles to the arc's ends the distance is that from its great circle, beyond them
that from the end: with u₁, u₂ across the arc and e along it at an end that is passed,
sin²(δ/2) = ((u₁·Q)² + (u₂·Q)² [+ (e·Q)²])/|Q|². The last term is never less than nothing, so that it bounds
δ wherever the side of the plane is not proved.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, inf, nextafter, sin
from typing import ClassVar

import numpy as np

from timelaw.motion.quaternion_curve import QuaternionCurve
from timelaw.motion.segment import Quantity
from timelaw.numerics.arc_frame import ArcFrame, frame_arc
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import UNIT_ROUNDOFF, evaluate, split
from timelaw.numerics.polynomial import Polynomial
from timelaw.numerics.quotient import Quotient

DEVIATION = "deviation"
GRID = 8  # places for each degree at which the side of a plane is looked at
ASIDE = 1e-9  # of a piece, by which a cut keeps from where a plane is passed
MISSED = 1e-9  # of Q across a plane; a motion may begin so much before its node
HALVINGS = 10  # of a part that may be on one side only


@dataclass(frozen=True)
class DeviationRow:
    """δ ≤ bound: |g| ≤ sin²(bound/2)."""

    angle: float
    limit: ClassVar[str] = DEVIATION
    label: ClassVar[str] = DEVIATION
    unit: ClassVar[str] = "rad"
    orders: ClassVar[tuple[int, ...]] = (0,)
    root: ClassVar[int] = 2
    note: ClassVar[str] = ""

    @property
    def bound(self) -> float:
        """On the square of the sine of half the angle, rounded so that it allows no more than the angle."""
        square = sin(min(self.angle, np.pi) / 2) ** 2
        while self.size(square) > self.angle:
            square = nextafter(square, 0.0)
        return square

    def size(self, value: float) -> float:
        """δ [rad], by sine and cosine: near half a turn one of them alone loses half of the digits."""
        square = min(abs(value), 1.0)
        return 2 * atan2(square**0.5, (1 - square) ** 0.5) if value < inf else inf

    def rate_bound(self, order: int) -> float:  # noqa: ARG002
        """It bounds no rate."""
        return inf


def list_deviations(
    start: Array, end: Array, pieces: Sequence[QuaternionCurve], breaks: Sequence[float], bound: float
) -> Iterator[Quantity]:
    """The row of a segment from `start` to `end`, part by part of each piece."""
    row, frame = DeviationRow(bound), frame_arc(start, end)
    for piece, first, last in zip(pieces, breaks[:-1], breaks[1:], strict=True):
        cuts = [0.0, *_find_cuts(piece.control, frame), 1.0]
        for a, b in pairwise(cuts):
            control, error = _restrict(piece.control, a, b)
            for low, high, own, more in _settle_sides(control, error, frame, HALVINGS):
                width = b - a
                ends = (
                    first + (last - first) * (a + width * low),
                    first + (last - first) * (a + width * high),
                )
                yield Quantity(row, _measure(own, more, frame), *ends)


def _measure(control: Array, error: float, frame: ArcFrame) -> Quotient:
    """sin²(δ/2) over control points (d+1, 4), the ends counted where the planes may be passed."""
    slack = _slack(control, error, frame)
    sides, passed = list(frame.across), 0.0
    for side in (frame.first, -frame.last):
        if _is_ahead(control @ side, slack):
            # where e·Q is negative, it is no lower than its control points
            passed += (2 * slack + max(-float(np.min(control @ side)), 0.0)) ** 2
        else:
            sides.append(side)
    terms = [Polynomial(control @ side, slack) for side in sides]
    square = _sum([term * term for term in terms])
    parts = [Polynomial(column, error) for column in control.T]
    return Quotient(Polynomial(square.control, square.error + passed), _sum([part * part for part in parts]))


def _sum(terms: Sequence[Polynomial]) -> Polynomial:
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total


def _slack(control: Array, error: float, frame: ArcFrame) -> float:
    """By how much a vector of the frame times Q may be off."""
    size = float(np.max(np.sum(np.abs(control), axis=1)))
    return size * (frame.error + 8 * UNIT_ROUNDOFF) + 4 * error


def _is_ahead(values: Array, slack: float) -> bool:
    """Whether a polynomial with these control points is nowhere negative by more than what counts."""
    return float(np.min(values)) >= -_overlook(values, slack)


def _overlook(values: Array, slack: float) -> float:
    """What is no passing of a plane: rounding, and what a node may be missed by."""
    return max(slack, MISSED * float(np.max(np.abs(values))))


def _find_cuts(control: Array, frame: ArcFrame) -> list[float]:
    """Near where the planes at the ends are passed, a little to the side on which the arc is."""
    u = np.linspace(0.0, 1.0, GRID * len(control))
    cuts = []
    for side in (frame.first, -frame.last):
        points = control @ side
        values, numbers = evaluate(points, u), points.tolist()
        for k in np.nonzero(np.signbit(values[1:]) != np.signbit(values[:-1]))[0]:
            low, high = float(u[k]), float(u[k + 1])
            rising = values[k + 1] > values[k]
            for _ in range(60):
                middle = (low + high) / 2
                behind = _evaluate(numbers, middle) < 0
                low, high = (middle, high) if behind == rising else (low, middle)
            cuts.append(high + ASIDE if rising else low - ASIDE)
    return sorted({cut for cut in cuts if 2 * ASIDE < cut < 1 - 2 * ASIDE})


def _evaluate(points: Sequence[float], u: float) -> float:
    """By de Casteljau at one place: NumPy would take thirty times as long."""
    while len(points) > 1:
        points = [(1 - u) * a + u * b for a, b in pairwise(points)]
    return points[0]


def _restrict(control: Array, a: float, b: float) -> tuple[Array, float]:
    """Control points (d+1, 4) over [a, b], and what rounding made of them."""
    size = float(np.max(np.abs(control)))
    rounding = 4 * len(control) * UNIT_ROUNDOFF * size
    found = control.T
    if b < 1:
        found = split(found, b)[0]
    if a > 0:
        found = split(found, a / b)[1]
    return found.T, rounding if (a > 0 or b < 1) else 0.0


def _settle_sides(
    control: Array, error: float, frame: ArcFrame, depth: int
) -> Iterator[tuple[float, float, Array, float]]:
    """Parts (from, to, control points, rounding), halved while a plane is not passed, as far as is seen."""
    slack = _slack(control, error, frame)
    sides = [control @ side for side in (frame.first, -frame.last)]
    open_ = [v for v in sides if not _is_ahead(v, slack) and min(v[0], v[-1]) >= -_overlook(v, slack)]
    if not open_ or not depth:
        yield 0.0, 1.0, control, error
        return
    left, right = split(control.T, 0.5)
    more = error + 4 * len(control) * UNIT_ROUNDOFF * float(np.max(np.abs(control)))
    for half, shift in ((left, 0.0), (right, 0.5)):
        for low, high, own, grown in _settle_sides(half.T, more, frame, depth - 1):
            yield shift + low / 2, shift + high / 2, own, grown
