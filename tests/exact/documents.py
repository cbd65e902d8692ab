"""Law documents from their parts, as plain data."""

from math import cos, sin, sqrt
from typing import Any

CONVENTIONS = {
    "quaternion": "wxyz, Hamilton, active, body to world",
    "rates": "body axes",
    "units": "rad, s",
}
X = [1.0, 0.0, 0.0]
ONE = [1.0, 0.0, 0.0, 0.0]


def piece(duration: float, state: list[float], control: list[float]) -> dict[str, Any]:
    """A piece of an arc."""
    return {"duration": duration, "state": state, "bernstein": control}


def quintic(angle: float, duration: float) -> dict[str, Any]:
    """The piece that turns by `angle` from rest to rest, its acceleration zero at both ends."""
    jerk = 60 * angle / duration**3
    return piece(duration, [0.0, 0.0, 0.0], [jerk, -2 * jerk, jerk])


def turn(start: list[float], axis: list[float], angle: float) -> list[float]:
    """Where a turn leads, in doubles, normalised."""
    w, x, y, z = start
    c, (a, b, d) = cos(angle / 2), (sin(angle / 2) * v for v in axis)
    led = [
        w * c - x * a - y * b - z * d,
        w * a + x * c + y * d - z * b,
        w * b - x * d + y * c + z * a,
        w * d + x * b - y * a + z * c,
    ]
    length = sqrt(sum(v * v for v in led))
    return [v / length for v in led]


def arc(
    origin: str,
    target: str,
    pieces: list[dict[str, Any]],
    *,
    axis: list[float] = X,
    angle: float = 1.0,
    start: list[float] = ONE,
    start_time: float = 0.0,
    limits: dict[str, Any] | None = None,
) -> dict[str, Any]:
    """An arc that lasts as long as its pieces."""
    return {
        "kind": "arc",
        "from": origin,
        "to": target,
        "start_time": start_time,
        "duration": max(sum(p["duration"] for p in pieces), 1e-9),
        "start": list(start),
        "end": turn(start, axis, angle),
        "axis": list(axis),
        "angle": angle,
        **({"limits": limits} if limits else {}),
        "pieces": pieces,
    }


def rational(
    origin: str, target: str, pieces: list[dict[str, Any]], *, limits: dict[str, Any] | None = None
) -> dict[str, Any]:
    """A rational segment from where its first control point is to where its last is."""
    ends = pieces[0]["control"][0], pieces[-1]["control"][-1]
    return {
        "kind": "rational",
        "from": origin,
        "to": target,
        "start_time": 0.0,
        "duration": min(max(sum(p["duration"] for p in pieces), 1e-9), 1e12),
        "start": unit(ends[0]),
        "end": unit(ends[1]),
        **({"limits": limits} if limits else {}),
        "pieces": pieces,
    }


def unit(vector: list[float]) -> list[float]:
    """Over its norm, in doubles."""
    largest = max(abs(x) for x in vector)
    length = sqrt(sum((x / largest) ** 2 for x in vector))
    return [x / largest / length for x in vector]


def dwell(at: str, duration: float, *, start_time: float, orientation: list[float]) -> dict[str, Any]:
    """A dwell."""
    return {
        "kind": "dwell",
        "at": at,
        "start_time": start_time,
        "duration": duration,
        "orientation": list(orientation),
    }


def document(segments: list[dict[str, Any]], limits: dict[str, Any], **others: Any) -> dict[str, Any]:
    """The law of these segments; `others` are its further keys."""
    last = segments[-1]
    return {
        "format": "timelaw-law",
        "version": 2,
        "name": "exact",
        "conventions": CONVENTIONS,
        "duration": last["start_time"] + last["duration"],
        "limits": limits,
        **others,
        "segments": segments,
    }
