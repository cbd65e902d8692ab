"""The law file, version 1, as plain data: quaternion law ⇄ the object that `law.json` holds."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from pydantic import ValidationError

from timelaw.easing import Easing
from timelaw.errors import Fault, InputError
from timelaw.limits import LIMITS, Bounds
from timelaw.motion.arc import Arc
from timelaw.motion.dwell import Dwell
from timelaw.motion.quaternion_law import QuaternionLaw
from timelaw.motion.schema import RATES, ArcDocument, DwellDocument, LawDocument

FORMAT = "timelaw-law"
VERSION = 1
CONVENTIONS = {
    "quaternion": "wxyz, Hamilton, active, body to world",
    "rates": "body axes",
    "units": "rad, s",
}


def to_document(law: QuaternionLaw) -> dict[str, Any]:
    """The part of the law file that defines the motion: format to segments, without certificate."""
    document: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "name": law.name,
        "conventions": CONVENTIONS,
        "duration": law.duration,
        "limits": _bounds(law.limits),
    }
    if law.continuity:
        document["continuity"] = law.continuity
    if law.inertia is not None:
        document["body"] = {"inertia": law.inertia.tolist()}
    if law.before or law.after:
        sides = {"before": law.before, "after": law.after}
        document["outside"] = {
            side: {RATES[k]: rate.tolist() for k, rate in rates.items()} for side, rates in sides.items()
        }
    document["segments"] = [_WRITERS[segment.kind](segment) for segment in law.segments]
    return document


def _bounds(limits: Mapping[str, Bounds]) -> dict[str, Any]:
    return {name: list(b) if isinstance(b, tuple) else b for name, b in limits.items()}


def _write_arc(arc: Arc) -> dict[str, Any]:
    own = {"limits": _bounds(arc.limits)} if arc.limits else {}
    return {
        "kind": arc.kind,
        "from": arc.origin,
        "to": arc.target,
        "start_time": arc.start_time,
        "duration": arc.duration,
        "start": arc.start.tolist(),
        "end": arc.end.tolist(),
        "axis": arc.axis.tolist(),
        "angle": arc.angle,
        **own,
        "easing": {
            "breaks": arc.easing.breaks.tolist(),
            "bernstein": [piece.tolist() for piece in arc.easing.pieces],
        },
    }


def _write_dwell(dwell: Dwell) -> dict[str, Any]:
    return {
        "kind": dwell.kind,
        "at": dwell.at,
        "start_time": dwell.start_time,
        "duration": dwell.duration,
        "orientation": dwell.orientation.tolist(),
    }


_WRITERS: dict[str, Callable[[Any], dict[str, Any]]] = {"arc": _write_arc, "dwell": _write_dwell}


def from_document(document: Any, path: str = "") -> QuaternionLaw:
    """The quaternion law that a law file defines; numbers are taken bit for bit.

    Raises:
        InputError: a key is missing or malformed, or the conventions are not these.
    """
    try:
        read = LawDocument.model_validate(document)
    except ValidationError as error:
        raise InputError(*(_fault(details, path) for details in error.errors())) from None
    if read.conventions != CONVENTIONS:
        raise InputError(Fault(f"{read.conventions}; allowed: {CONVENTIONS}", "conventions", path))
    inertia = np.array(read.body.inertia, dtype=float) if read.body else None
    if not read.limits:
        raise InputError(Fault("at least one limit is needed, or there is nothing to prove", "limits", path))
    for limits in (read.limits, *(s.limits for s in read.segments if isinstance(s, ArcDocument))):
        _check_limits(limits, inertia, path)
    outside = (read.outside.before, read.outside.after) if read.outside else (None, None)
    before, after = (
        {k: np.array(getattr(rates, name), dtype=float) for k, name in RATES.items()} if rates else {}
        for rates in outside
    )
    segments = tuple(_arc(s) if isinstance(s, ArcDocument) else _dwell(s) for s in read.segments)
    return QuaternionLaw(
        read.name, segments, _read_bounds(read.limits), inertia, read.continuity, before, after
    )


def _check_limits(limits: Mapping[str, Any], inertia: Any, path: str) -> None:
    for name in limits:
        if name not in LIMITS:
            raise InputError(Fault(f'unknown limit "{name}"; known: {", ".join(LIMITS)}', "limits", path))
        if LIMITS[name].needs_inertia and inertia is None:
            raise InputError(Fault(f'a limit on the {name} needs "body": {{"inertia": …}}', "limits", path))


def _read_bounds(limits: Mapping[str, Any]) -> dict[str, Bounds]:
    return {name: (b[0], b[1], b[2]) if isinstance(b, list) else float(b) for name, b in limits.items()}


def _arc(s: ArcDocument) -> Arc:
    easing = Easing(np.array(s.easing.breaks), tuple(np.array(c, dtype=float) for c in s.easing.bernstein))
    start, end, axis = (np.array(v, dtype=float) for v in (s.start, s.end, s.axis))
    limits = _read_bounds(s.limits)
    return Arc(s.origin, s.target, s.start_time, s.duration, start, end, axis, s.angle, easing, limits)


def _dwell(s: DwellDocument) -> Dwell:
    return Dwell(s.at, s.start_time, s.duration, np.array(s.orientation, dtype=float))


def _fault(details: Any, path: str) -> Fault:
    location = details["loc"]
    named = [
        p for i, p in enumerate(location) if not (p in _WRITERS and i and isinstance(location[i - 1], int))
    ]
    where = "".join(f"[{p}]" if isinstance(p, int) else f".{p}" for p in named).lstrip(".")
    return Fault(details["msg"], where, path)
