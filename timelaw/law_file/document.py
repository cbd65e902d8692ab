"""The law file, version 2, as plain data: quaternion law ⇄ the object that `law.json` holds."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from pydantic import ValidationError

from timelaw.errors import Fault, InputError, list_first, shorten
from timelaw.law_file.schema import BodyDocument, LawDocument
from timelaw.limits import LIMITS
from timelaw.limits.body import EXTERNAL, RigidBody, find_impossibility
from timelaw.limits.bounds import read_bounds, write_bounds
from timelaw.limits.registry import POINT
from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.kinds import KINDS
from timelaw.motion.segment import RATES

FORMAT = "timelaw-law"
VERSION = 2
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
        "limits": write_bounds(law.limits),
    }
    if law.continuity:
        document["continuity"] = law.continuity
    if law.body is not None or law.shape is not None:
        document["body"] = _write_body(law)
    if law.before or law.after:
        sides = {"before": law.before, "after": law.after}
        document["outside"] = {
            side: {RATES[k]: rate.tolist() for k, rate in rates.items()} for side, rates in sides.items()
        }
    if law.periodic:
        document["periodic"] = True
    document["segments"] = [segment.document() for segment in law.segments]
    return document


def from_document(document: Any, path: str = "") -> QuaternionLaw:
    """The quaternion law that a law file defines; numbers are taken bit for bit.

    Raises:
        InputError: a key is missing or malformed, or the conventions are not these.
    """
    try:
        read = LawDocument.model_validate(document)
    except ValidationError as error:
        found = (_fault(details, path) for details in error.errors(include_url=False))
        raise InputError(*list_first(found, error.error_count(), path)) from None
    if read.conventions != CONVENTIONS:
        raise InputError(
            Fault(f"{shorten(str(read.conventions))}; allowed: {CONVENTIONS}", "conventions", path)
        )
    given = read.body
    body = _read_body(given, given.inertia, path) if given and given.inertia else None
    shape = given.shape if given else None
    if not read.limits:
        raise InputError(Fault("at least one limit is needed, or there is nothing to prove", "limits", path))
    segments = tuple(KINDS[segment.kind].read(segment) for segment in read.segments)
    travels = _travels(segments, path)
    _check_limits(read.limits, body, path, travels=travels)
    for segment in segments:
        own = set(segment.own_limits)
        others = {name: bounds for name, bounds in segment.limits.items() if name not in own}
        _check_limits(others, body, path, travels=travels)
        for name in own & set(segment.limits):
            if not isinstance(segment.limits[name], float):
                raise InputError(Fault("one angle [rad] is needed", f"limits.{name}", path))
    outside = (read.outside.before, read.outside.after) if read.outside else (None, None)
    before, after = (
        {k: np.array(getattr(rates, name), dtype=float) for k, name in RATES.items()} if rates else {}
        for rates in outside
    )
    if read.periodic and read.outside:
        raise InputError(Fault('a motion that goes round has no "outside"', "periodic", path))
    return QuaternionLaw(
        read.name,
        segments,
        read_bounds(read.limits),
        body,
        read.continuity,
        before,
        after,
        read.periodic,
        shape,
    )


def _travels(segments: Sequence[Segment], path: str) -> bool:
    """Whether the body's origin moves: in all segments, or in none."""
    travelling = [segment.travels for segment in segments]
    if any(travelling) and not all(travelling):
        index = travelling.index(False)
        key = "points" if segments[index].moves else "point"
        message = f'the body\'s origin moves in other segments; "{key}" is needed here too'
        raise InputError(Fault(message, f"segments[{index}]", path))
    return all(travelling)


def _write_body(law: QuaternionLaw) -> dict[str, Any]:
    """The inertia, who turns the body if it is not turned from outside, and its shape."""
    body, document = law.body, {}
    if body is not None:
        document["inertia"] = body.inertia.tolist()
        if body.actuator != EXTERNAL:
            document |= {"actuator": body.actuator, "momentum": body.momentum.tolist()}
    return document if law.shape is None else document | {"shape": list(law.shape)}


def _read_body(body: BodyDocument, rows: Sequence[Sequence[float]], path: str) -> RigidBody:
    inertia, momentum = (np.array(part, dtype=float) for part in (rows, body.momentum))
    with np.errstate(over="ignore", invalid="ignore"):  # what overflows is refused
        reason = find_impossibility(inertia)
    if reason:
        raise InputError(Fault(reason, "body.inertia", path))
    return RigidBody(inertia, body.actuator, momentum)


def _check_limits(limits: Mapping[str, Any], body: RigidBody | None, path: str, *, travels: bool) -> None:
    for name, bounds in limits.items():
        if name not in LIMITS:
            raise InputError(
                Fault(f'unknown limit "{shorten(name)}"; known: {", ".join(LIMITS)}', "limits", path)
            )
        if LIMITS[name].needs_inertia and body is None:
            raise InputError(Fault(f'a limit on the {name} needs "body": {{"inertia": …}}', "limits", path))
        if LIMITS[name].needs_translation and not travels:
            message = f'a limit on the {name} needs a translation: "points" in the pieces of every segment'
            raise InputError(Fault(message, "limits", path))
        reason = LIMITS[name].contradiction(bounds, body or POINT)
        if reason:
            raise InputError(Fault(reason, f"limits.{name}", path))


def _fault(details: Any, path: str) -> Fault:
    location = details["loc"]
    named = [p for i, p in enumerate(location) if not (p in KINDS and i and isinstance(location[i - 1], int))]
    where = "".join(f"[{p}]" if isinstance(p, int) else f".{p}" for p in named).lstrip(".")
    return Fault(shorten(details["msg"]), shorten(where), path)
