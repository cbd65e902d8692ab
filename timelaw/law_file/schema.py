"""What a law file may hold, as models: its head, and segments of every kind."""

from typing import TYPE_CHECKING, Annotated, Any, Literal, Self, Union

from pydantic import AfterValidator, BeforeValidator, FailFast, Field, model_validator

from timelaw.limits.body import EXTERNAL, WHEELS
from timelaw.limits.torque import ACTUATORS
from timelaw.motion.kinds import KINDS
from timelaw.motion.schema import BoundsDocument, Duration, Moderate3, Part, Text, Vector3, refuse_many
from timelaw.units import LEAST, MOST

if TYPE_CHECKING:
    SegmentDocument = Any
else:
    SegmentDocument = Union[tuple(kind.document_model for kind in KINDS.values())]  # noqa: UP007


def _no_truth(value: Any) -> Any:
    """A number, which Python takes `true` for."""
    if isinstance(value, bool):
        raise ValueError("Input should be 2")
    return value


def _known_actuator(value: str) -> str:
    """One of the registry."""
    if value not in ACTUATORS:
        raise ValueError(f"one of {', '.join(ACTUATORS)} is needed")
    return value


Edge = Annotated[float, Field(ge=LEAST, le=MOST)]


class BodyDocument(Part):
    """The body, where a limit needs to know its inertia, or a picture its shape: the edges of a box [m]."""

    inertia: Annotated[list[Moderate3], Field(min_length=3, max_length=3)] | None = None
    actuator: Annotated[str, AfterValidator(_known_actuator)] = EXTERNAL
    momentum: Moderate3 = Field(default_factory=lambda: [0.0, 0.0, 0.0])
    shape: tuple[Edge, Edge, Edge] | None = Field(default=None, strict=False)

    @model_validator(mode="after")
    def _something(self) -> Self:
        if self.inertia is None and self.shape is None:
            raise ValueError("an inertia or a shape is needed")
        return self

    @model_validator(mode="after")
    def _momentum_is_the_wheels(self) -> Self:
        if any(self.momentum) and self.actuator != WHEELS:
            raise ValueError(f'a total momentum belongs to the actuator "{WHEELS}"')
        return self


class RatesDocument(Part):
    """Rates just outside the motion, in body axes; zero where they are not given."""

    omega: Vector3 = Field(default_factory=lambda: [0.0, 0.0, 0.0])
    alpha: Vector3 = Field(default_factory=lambda: [0.0, 0.0, 0.0])
    jerk: Vector3 = Field(default_factory=lambda: [0.0, 0.0, 0.0])
    snap: Vector3 = Field(default_factory=lambda: [0.0, 0.0, 0.0])


class OutsideDocument(Part):
    """How the motion is entered and left where that is not at rest."""

    before: RatesDocument = RatesDocument()
    after: RatesDocument = RatesDocument()


class LawDocument(Part):
    """What a reader needs of a law file."""

    format: Literal["timelaw-law"]
    version: Annotated[Literal[2], BeforeValidator(_no_truth)]
    name: Text
    conventions: Annotated[dict[str, str], BeforeValidator(refuse_many)]
    duration: Duration
    limits: BoundsDocument
    continuity: Annotated[int, Field(ge=0, le=4)] = 0
    body: BodyDocument | None = None
    outside: OutsideDocument | None = None
    periodic: bool = False
    segments: Annotated[
        list[Annotated[SegmentDocument, Field(discriminator="kind")]], Field(min_length=1), FailFast()
    ]
