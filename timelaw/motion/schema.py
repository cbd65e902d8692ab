"""What a law file may hold: its parts as models, with the ranges in which numbers make sense."""

from itertools import pairwise
from math import pi
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from timelaw.units import LEAST, MOST

SHORTEST, LONGEST = 1e-9, 1e12  # s; cubes and fourth powers of times stay far from overflow
NARROWEST = 1e-12  # interval of an easing
WIDEST = 1e6  # control point of an easing, which runs from 0 to 1
LARGEST_ANGLE = pi + 1e-6  # rad; a leg goes the shorter way round

Number = Annotated[float, Field(allow_inf_nan=False)]
Control = Annotated[float, Field(ge=-WIDEST, le=WIDEST)]
Duration = Annotated[float, Field(ge=SHORTEST, le=LONGEST)]
Vector3 = Annotated[list[Number], Field(min_length=3, max_length=3)]
Vector4 = Annotated[list[Number], Field(min_length=4, max_length=4)]
BoundsDocument = dict[str, Annotated[Any, AfterValidator(lambda value: _bound(value))]]
RATES = {1: "omega", 2: "alpha", 3: "jerk", 4: "snap"}


def _no_truth(value: Any) -> Any:
    """The number 1, which Python takes `true` for."""
    if isinstance(value, bool):
        raise ValueError("Input should be 1")
    return value


def _bound(value: Any) -> Any:
    """A positive number, or three of them."""
    numbers = value if isinstance(value, list) and len(value) == 3 else [value]
    for number in numbers:
        plain = isinstance(number, int | float) and not isinstance(number, bool)
        if not (plain and LEAST**2 <= number <= MOST**2):
            raise ValueError("a positive number, or three for the body axes, is needed")
    return value


class _Part(BaseModel):
    """Unknown keys are left alone: a later version may write more."""

    model_config = ConfigDict(strict=True, extra="ignore")


class EasingDocument(_Part):
    """Bernstein control points of f on each interval of `breaks` ⊂ [0, 1]."""

    breaks: Annotated[list[Number], Field(min_length=2)]
    bernstein: Annotated[
        list[Annotated[list[Control], Field(min_length=2, max_length=64)]], Field(min_length=1)
    ]

    @model_validator(mode="after")
    def _intervals(self) -> "EasingDocument":
        ascending = all(b - a >= NARROWEST for a, b in pairwise(self.breaks))
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
    duration: Duration
    start: Vector4
    end: Vector4
    axis: Vector3
    angle: Annotated[float, Field(ge=NARROWEST, le=LARGEST_ANGLE)]
    easing: EasingDocument
    limits: BoundsDocument = {}


class DwellDocument(_Part):
    """A segment of kind `dwell`."""

    kind: Literal["dwell"]
    at: str
    start_time: Number
    duration: Duration
    orientation: Vector4


class BodyDocument(_Part):
    """The body, where a limit needs to know it."""

    inertia: Annotated[list[Vector3], Field(min_length=3, max_length=3)]


class RatesDocument(_Part):
    """Rates just outside the motion, in body axes; zero where they are not given."""

    omega: Vector3 = [0.0, 0.0, 0.0]
    alpha: Vector3 = [0.0, 0.0, 0.0]
    jerk: Vector3 = [0.0, 0.0, 0.0]
    snap: Vector3 = [0.0, 0.0, 0.0]


class OutsideDocument(_Part):
    """How the motion is entered and left where that is not at rest."""

    before: RatesDocument = RatesDocument()
    after: RatesDocument = RatesDocument()


class LawDocument(_Part):
    """What a reader needs of a law file."""

    format: Literal["timelaw-law"]
    version: Annotated[Literal[1], BeforeValidator(_no_truth)]
    name: str
    conventions: dict[str, str]
    duration: Duration
    limits: BoundsDocument
    continuity: Annotated[int, Field(ge=0, le=4)] = 0
    body: BodyDocument | None = None
    outside: OutsideDocument | None = None
    segments: Annotated[
        list[Annotated[ArcDocument | DwellDocument, Field(discriminator="kind")]], Field(min_length=1)
    ]
