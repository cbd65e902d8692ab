"""Where easings laid along Bézier curves become the motion: Q∘f on each piece, a polynomial in time again."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from timelaw.bezier.curve import Curve
from timelaw.easing import Timing
from timelaw.limits import Bounds
from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.dwell import Dwell
from timelaw.motion.origin_curve import OriginCurve
from timelaw.motion.quaternion_curve import QuaternionCurve
from timelaw.motion.rational import Rational
from timelaw.numerics.array import Array
from timelaw.numerics.composition import Wide, compose_control, halve_control, integrate_state
from timelaw.numerics.joined import round_joined

UNEVEN = 6.0  # largest over least control point of |Q|² on a piece; of its sixth power five digits are lost
MOST_HALVINGS = 6  # of a piece of an easing


@dataclass(frozen=True)
class Legwork:
    """A curve, its timing of class C^`continuity`, how many derivatives vanish at its ends, its limits."""

    curve: Curve
    timing: Timing
    continuity: int
    still: tuple[int, int]
    limits: Mapping[str, Bounds]


def compose_curves(head: QuaternionLaw, legs: Sequence[Legwork], dwells: Sequence[float]) -> QuaternionLaw:
    """The law `head` with its segments: legs one after the other, `dwells` [s] (n+1) at their nodes."""
    segments: list[Segment] = []
    start = 0.0
    for index, leg in enumerate(legs):
        if dwells[index]:
            segments.append(_rest(leg.curve, 0, start, dwells[index]))
            start += dwells[index]
        segments.append(_follow(leg, start))
        start += leg.timing.duration
    if dwells[len(legs)]:
        segments.append(_rest(legs[-1].curve, -1, start, dwells[-1]))
    return replace(head, segments=tuple(segments))


def _rest(curve: Curve, end: int, start: float, duration: float) -> Dwell:
    """A dwell at the first (0) or last (-1) point of a curve."""
    u = np.array([0.0 if end == 0 else 1.0])
    point = None if curve.points is None else curve.place(u, 0)[0][0]
    label = curve.origin if end == 0 else curve.target
    return Dwell(label, start, duration, curve.orientation(u)[0], point)


def _follow(leg: Legwork, start: float) -> Rational:
    curve, timing = leg.curve, leg.timing
    parts = [
        (duration * timing.duration, easing)
        for piece in timing.easing.pieces
        for duration, easing in _cut(
            curve, piece.duration, integrate_state(piece.duration, piece.state, piece.control), MOST_HALVINGS
        )
    ]
    pieces = tuple(map(QuaternionCurve, *_compose(curve.control, parts, leg)))
    origins: tuple[OriginCurve, ...] = ()
    if curve.numerator is not None:
        origins = tuple(map(OriginCurve, _compose(curve.numerator, parts, leg)[1], pieces))
    first, last = curve.orientation(np.array([0.0, 1.0]))
    return Rational(
        curve.origin,
        curve.target,
        start,
        timing.duration,
        first,
        last,
        pieces,
        leg.limits,
        origins,
    )


def _cut(curve: Curve, duration: float, easing: Wide, halvings: int) -> Iterator[tuple[float, Wide]]:
    """An easing in pieces on which the control points of |Q∘f|² are near their values.

    High powers of |Q|² stand below what is limited: where its control points differ much, rounding hides the
    least of them, and nothing is proved.
    """
    square = compose_control(curve.square, easing)
    if halvings == 0 or np.max(np.abs(square)) <= UNEVEN * np.min(square):
        yield duration, easing
        return
    for half in halve_control(easing):
        yield from _cut(curve, duration / 2, half, halvings - 1)


def _compose(
    outer: Array, parts: Sequence[tuple[float, Wide]], leg: Legwork
) -> tuple[list[float], list[Array]]:
    """Durations and control points; at an end where k derivatives vanish k + 1 points are the same."""
    durations = [duration for duration, _ in parts]
    found = round_joined([compose_control(outer, easing) for _, easing in parts], durations, leg.continuity)
    first, last = leg.still
    found[0][: first + 1] = outer[0]
    found[-1][len(found[-1]) - 1 - last :] = outer[-1]
    return durations, found
