"""Limits for all t: the exact maximum of each limited quantity on each segment, against its bound."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from flint import arb, fmpq, fmpq_poly

from tests.exact.curve_limits import LINEAR_ORDERS, NORM, RATE_ORDERS, measure_curves, measure_origins
from tests.exact.deviation import measure_deviation
from tests.exact.motion import Motion
from tests.exact.pieces import Piece
from tests.exact.polynomials import enclose_size
from tests.exact.rational import ROUNDING, largest, nearby, norm, read, read_all, root, show, within
from tests.exact.segments import Arc, Segment

LIMIT_ORDERS = {**RATE_ORDERS, "torque": 2, "momentum": 1}
DEVIATION = "deviation"
AXES = ("x", "y", "z")


@dataclass(frozen=True)
class Limited:
    """One limit on one segment: the exact maximum there, a ball, and its bound.

    `gross` is what the quantity is at most if none of its sums cancels.
    """

    label: str
    bound: fmpq
    maximum: arb
    gross: float
    segment: Segment

    @property
    def broken(self) -> bool:
        """Whether the maximum is above the bound, surely."""
        return bool(self.maximum > arb(self.bound * (1 + ROUNDING)))

    @property
    def finding(self) -> str:
        """What is wrong."""
        return f"P5 {self.label} reaches {show(self.maximum)} over {show(self.bound)} in {self.segment.place}"


def list_limited(motion: Motion) -> Iterator[Limited]:
    """Every limit on every segment on which it holds, in parts where it is given by axis."""
    for segment in motion.segments:
        if DEVIATION in segment.limits:
            ends = (read_all(segment.data[key]) for key in ("start", "end"))
            bound = read(segment.limits[DEVIATION])
            yield Limited(DEVIATION, bound, *measure_deviation(segment.pieces, *ends), segment)
        for limits, place in ((motion.limits, ""), (segment.limits, f" on {segment.name}")):
            for name, bounds in limits.items():
                if name == DEVIATION:
                    continue
                for axis, bound, label in _split(name, bounds):
                    maximum, gross = measure(motion, segment, name, axis)
                    yield Limited(label + place, bound, maximum, gross, segment)


def _split(name: str, bounds: Any) -> list[tuple[int, fmpq, str]]:
    if not isinstance(bounds, list):
        return [(NORM, read(bounds), name)]
    return [(i, read(bound), f"{name} {AXES[i]}") for i, bound in enumerate(bounds)]


def measure(motion: Motion, segment: Segment, name: str, axis: int) -> tuple[arb, float]:
    """The maximum of one limited quantity on a segment, and what it would be if nothing cancelled."""
    if not segment.moves:
        total = norm(motion.momentum) if name == "momentum" else arb(0)
        return total, float(total.mid())
    if name in LINEAR_ORDERS:
        return measure_origins(segment.origins, LINEAR_ORDERS[name], axis)
    if segment.curved:
        return measure_curves(motion, segment, name, axis)
    if name in RATE_ORDERS:
        order = RATE_ORDERS[name]
        return _scale(segment, part(segment.axis, axis) / segment.length, order), segment.gross(order)
    if name == "momentum":
        return _measure_momentum(motion, segment, axis)
    if not motion.wheels:
        return _measure_external(motion, segment, axis)
    return _measure_wheels(motion, segment, axis)


def part(vector: list, axis: int) -> arb:
    """|v_i|, or |v|."""
    return norm(vector) if axis == NORM else arb(abs(vector[axis]))


def _scale(segment: Arc, factor: arb, order: int) -> arb:
    return factor * segment.size(order)


def _gross_factor(motion: Motion, segment: Arc) -> float:
    """What (J n)_i is at most if nothing cancels."""
    return max(
        sum(abs(float(x)) * abs(float(a)) for x, a in zip(row, segment.axis, strict=True))
        for row in motion.inertia
    )


def _measure_momentum(motion: Motion, segment: Arc, axis: int) -> tuple[arb, float]:
    """|J n φ'| + |H|, or by axis."""
    carried, _ = motion.carry(segment)
    total = norm(motion.momentum)
    gross = _gross_factor(motion, segment) * segment.gross(1) + float(total.mid())
    return _scale(segment, part(carried, axis) / segment.length, 1) + total, gross


def _measure_external(motion: Motion, segment: Arc, axis: int) -> tuple[arb, float]:
    """|J n φ'' + (n × J n) φ'²|, or by axis."""
    carried, turned = motion.carry(segment)
    square = segment.squared_length
    gross = _gross_factor(motion, segment) * (segment.gross(2) + 2 * segment.gross(1) ** 2)
    if axis == NORM:
        # J n and n × J n are at right angles
        a = sum(x * x for x in carried) / square
        b = sum(x * x for x in turned) / square**2
        return largest([piece.torque(a, b) for piece in segment.pieces]), gross
    maximum = largest(
        [
            combine(carried[axis], turned[axis] / segment.length, piece.rate(2), piece.rate(1) ** 2, piece)
            for piece in segment.pieces
        ]
    )
    return maximum / segment.length, gross


def _measure_wheels(motion: Motion, segment: Arc, axis: int) -> tuple[arb, float]:
    """|J n φ''| + |H| |φ'|, or by axis |(J n)_i φ''| + |H| √(1 - n_i²) |φ'|."""
    carried, _ = motion.carry(segment)
    square = segment.squared_length
    factor, total = part(carried, axis) / segment.length, norm(motion.momentum)
    aslant = arb(1) if axis == NORM else root((square - segment.axis[axis] ** 2) / square)
    gross = _gross_factor(motion, segment) * segment.gross(2) + float(total.mid()) * segment.gross(1)
    if factor.is_zero():
        return _scale(segment, total * aslant, 1), gross
    # the larger of both senses is the sum of the sizes
    drift = total * aslant / factor
    sizes = [
        combine(fmpq(1), sense * drift, piece.rate(2), piece.rate(1), piece)
        for piece in segment.pieces
        for sense in ((1, -1) if not drift.is_zero() else (1,))
    ]
    return factor * largest(sizes), gross


def combine(a: fmpq, b: arb, first: fmpq_poly, second: fmpq_poly, piece: Piece) -> arb:
    """max |a first + b second|, b a ball: a rational in it is taken, and its distance counted."""
    middle, radius = nearby(b)
    if middle == 0 and b.is_zero():
        return abs(arb(a)) * piece.size(2)
    combined = a * first + middle * second
    return enclose_size(combined) + within(radius * gross_of(second))


def gross_of(p: fmpq_poly) -> arb:
    """A bound on |p| over [0, 1]: the sum of the sizes of its coefficients."""
    return arb(sum((abs(c) for c in p.coeffs()), fmpq(0)))


def find_broken_limits(motion: Motion) -> list[str]:
    """P5: limits that are exceeded somewhere."""
    return [limited.finding for limited in list_limited(motion) if limited.broken]
