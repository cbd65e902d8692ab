"""Laws made by hand that keep every promise, to be broken in one respect each."""

import copy
from collections.abc import Callable
from typing import Any

from tests.exact.documents import ONE, X, arc, document, dwell, piece, quintic, turn

Y = [0.0, 1.0, 0.0]
ASLANT = [0.48, 0.6, 0.64]
LIMITS = {"velocity": 10.0, "acceleration": 50.0, "jerk": 500.0}
PEAK_SPEED = 15 / 8  # of a quintic of angle 1 in the time 1
PEAK_ACCELERATION = 10 / 3**0.5

Document = dict[str, Any]


def follow(*segments: dict[str, Any]) -> list[dict[str, Any]]:
    """The segments one after the other."""
    time = 0.0
    for segment in segments:
        segment["start_time"] = time
        time += segment["duration"]
    return list(segments)


def make_arcs(
    angles: tuple[float, ...] = (1.0, 1.0), *, axes: tuple[list[float], ...] = (X, Y), time: float = 1.0
) -> list[dict[str, Any]]:
    """Quintic arcs about axes in turn, each from where the one before leads."""
    segments, start = [], ONE
    for k, angle in enumerate(angles):
        axis = axes[k % len(axes)]
        pieces = [quintic(angle, time)]
        segments.append(arc(str(k + 1), str(k + 2), pieces, axis=axis, angle=angle, start=start))
        start = turn(start, axis, angle)
    return follow(*segments)


def make_law(**changes: Any) -> Document:
    """Two arcs with a corner between them."""
    return document(make_arcs(), **{"limits": dict(LIMITS), "continuity": 2, **changes})


def make_dwells(*durations: float, time: float = 1.0) -> Document:
    """An arc, dwells, and another arc, each arc in the same `time`."""
    first, second = make_arcs(time=time)
    dwells = [dwell("2", duration, start_time=0.0, orientation=first["end"]) for duration in durations]
    return document(follow(first, *dwells, second), dict(LIMITS), continuity=2)


def make_pieces(count: int = 12) -> Document:
    """One arc turned through at rest's ease in one piece, then steadily in many more, and braked."""
    steady = [piece(0.125, [k * 0.125 + 0.5, 1.0, 0.0], [0.0]) for k in range(count)]
    ramp = piece(1.0, [0.0, 0.0, 0.0], [6.0, -6.0])
    stop = piece(1.0, [0.5 + count * 0.125, 1.0, 0.0], [-6.0, 6.0])
    angle = 1.0 + count * 0.125
    return document([arc("1", "2", [ramp, *steady, stop], angle=angle)], dict(LIMITS), continuity=2)


def make_there_and_back() -> list[dict[str, Any]]:
    """From 1 to 2, back to 1, and slowly to 2 again: two legs of one name."""
    go = arc("1", "2", [quintic(1.0, 1.0)])
    back = arc("2", "1", [quintic(1.0, 1.0)], axis=[-1.0, 0.0, 0.0], start=go["end"])
    return follow(go, back, arc("1", "2", [quintic(1.0, 2.0)], start=back["end"]))


def make_body_law(limits: dict[str, Any], body: Document, axis: list[float] = ASLANT) -> Document:
    """One arc of angle 1 about an axis, in the time 1, of a body."""
    segment = arc("1", "2", [quintic(1.0, 1.0)], axis=axis)
    return document([segment], limits, continuity=2, body=body)


def make_jump(size: float, *segments: dict[str, Any], limits: Document | None = None) -> Document:
    """An arc whose acceleration jumps by `size` at half its way, after other segments; C2 is asked for.

    φ' is 1 in both its pieces where they meet; the first speeds up to it, the second goes on from there.
    """
    first = piece(1.0, [0.0, 0.0, 0.0], [6.0, -6.0])
    second = piece(1.0, [0.5, 1.0, size], [-6.0 - 4 * size, 6.0 + 2 * size])
    start = segments[-1]["end"] if segments else ONE
    label = len(segments) + 1
    jump = arc(str(label), str(label + 1), [first, second], angle=1 + size / 12, start=start)
    return document(follow(*segments, jump), limits or {"velocity": 10.0}, continuity=2)


def make_steady() -> Document:
    """A turn at constant speed, entered and left at it, whose acceleration is rounding alone."""
    pieces = [piece(0.5, [0.0, 1.0, 1e-16], [1e-15]), piece(0.5, [0.5, 1.0, -2e-16], [0.0])]
    outside = {side: {"omega": [1.0, 0.0, 0.0]} for side in ("before", "after")}
    return document([arc("1", "2", pieces)], {"velocity": 2.0}, continuity=2, outside=outside)


def change(document: Document, alter: Callable[[Document], Any]) -> Document:
    """An altered copy."""
    altered = copy.deepcopy(document)
    alter(altered)
    return altered
