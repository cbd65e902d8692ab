"""What a law file says of rational segments: durations and control points, within the range of doubles."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from timelaw.motion.moving import LegDocument
from timelaw.motion.schema import BRIEFEST, LONGEST, Part

WEIGHT = 1e6  # largest component of a control point: gauges near one, far from where squares overflow
FARTHEST = 1e12  # m
MOST_CONTROL, MOST_POINTS = 64, 200  # of a piece: degree 63, as far as easings and their paths get together
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
