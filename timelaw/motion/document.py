"""The law file, version 1, as plain data: quaternion law ⇄ the object that `law.json` holds."""

from itertools import pairwise
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from timelaw.easing import Easing
from timelaw.errors import Fault, InputError
from timelaw.limits import LIMITS
from timelaw.motion.arc import Arc
from timelaw.motion.quaternion_law import QuaternionLaw

FORMAT = "timelaw-law"
VERSION = 1
CONVENTIONS = {
    "quaternion": "wxyz, Hamilton, active, body to world",
    "rates": "body axes",
    "units": "rad, s",
}

Number = Annotated[float, Field(allow_inf_nan=False)]
Vector3 = Annotated[list[Number], Field(min_length=3, max_length=3)]
Vector4 = Annotated[list[Number], Field(min_length=4, max_length=4)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class _Part(BaseModel):
    """Unknown keys are left alone: a later version may write more."""

    model_config = ConfigDict(strict=True, extra="ignore")


class EasingDocument(_Part):
    """Bernstein control points of f on each interval of `breaks` ⊂ [0, 1]."""

    breaks: Annotated[list[Number], Field(min_length=2)]
    bernstein: Annotated[
        list[Annotated[list[Number], Field(min_length=2, max_length=64)]], Field(min_length=1)
    ]

    @model_validator(mode="after")
    def _intervals(self) -> "EasingDocument":
        ascending = all(a < b for a, b in pairwise(self.breaks))
        if self.breaks[0] != 0 or self.breaks[-1] != 1 or not ascending:
            raise ValueError("breaks must ascend from 0 to 1")
        if len(self.bernstein) != len(self.breaks) - 1:
            raise ValueError(f"{len(self.breaks) - 1} intervals need as many lists of control points")
        return self


class ArcDocument(_Part):
    """A segment of kind `arc`."""

    kind: Literal["arc"]
    origin: Annotated[str, Field(alias="from")]
    target: Annotated[str, Field(alias="to")]
    start_time: Number
    duration: Positive
    start: Vector4
    end: Vector4
    axis: Vector3
    angle: Positive
    easing: EasingDocument


class LawDocument(_Part):
    """What a reader needs of a law file."""

    format: Literal["timelaw-law"]
    version: Literal[1]
    name: str
    conventions: dict[str, str]
    duration: Positive
    limits: dict[str, Positive]
    segments: Annotated[list[ArcDocument], Field(min_length=1)]


def to_document(law: QuaternionLaw) -> dict[str, Any]:
    """The part of the law file that defines the motion: format to segments, without certificate."""
    return {
        "format": FORMAT,
        "version": VERSION,
        "name": law.name,
        "conventions": CONVENTIONS,
        "duration": law.duration,
        "limits": dict(law.limits),
        "segments": [_segment(segment) for segment in law.segments],
    }


def _segment(arc: Arc) -> dict[str, Any]:
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
        "easing": {
            "breaks": arc.easing.breaks.tolist(),
            "bernstein": [piece.tolist() for piece in arc.easing.pieces],
        },
    }


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
    unknown = [name for name in read.limits if name not in LIMITS]
    if unknown:
        raise InputError(Fault(f'unknown limit "{unknown[0]}"; known: {", ".join(LIMITS)}', "limits", path))
    return QuaternionLaw(read.name, tuple(_arc(s) for s in read.segments), read.limits)


def _arc(s: ArcDocument) -> Arc:
    easing = Easing(np.array(s.easing.breaks), tuple(np.array(c, dtype=float) for c in s.easing.bernstein))
    start, end, axis = (np.array(v, dtype=float) for v in (s.start, s.end, s.axis))
    return Arc(s.origin, s.target, s.start_time, s.duration, start, end, axis, s.angle, easing)


def _fault(details: Any, path: str) -> Fault:
    where = "".join(f"[{p}]" if isinstance(p, int) else f".{p}" for p in details["loc"]).lstrip(".")
    return Fault(details["msg"], where, path)
