"""The model of a problem file, version 1: which keys there are and what they may hold."""

from collections.abc import Callable, Iterable
from difflib import get_close_matches
from typing import Annotated, Any, Literal, Self, get_args

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from timelaw.problem.units import (
    ANGULAR_ACCELERATION,
    ANGULAR_JERK,
    ANGULAR_VELOCITY,
    FREQUENCY,
    Kind,
    parse_quantity,
)

LatticeName = Literal["16-cell", "tesseract", "24-cell", "600-cell", "120-cell"]
TourName = Literal["paper", "shortest", "given"]
Baseline = Literal["quintic", "double-s"]
TOURS: tuple[str, ...] = get_args(TourName)
MAX_DEGREE = 31
LEAST, MOST = 1e-9, 1e9  # in SI; no body is that slow or fast, and cubes of times stay far from overflow
NORM_TOLERANCE = 1e-3  # a quaternion typed with four digits still counts as a unit quaternion


def fault(message: str, *where: str) -> PydanticCustomError:
    """A validation error whose text is shown to the user as it stands, at `where` below its model."""
    return PydanticCustomError("timelaw", "{message}", {"message": message, "where": where})


def quoted(value: Any) -> str:
    """A value as a message shows it."""
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else f"{value}"


def nearest(given: Any, allowed: Iterable[str], *others: str) -> str:
    """The allowed values as a text, the likeliest name pointed out."""
    names = list(allowed)
    close = get_close_matches(str(given), names, n=1, cutoff=0.6)
    listing = ", ".join([*names, *others])
    return f'{listing}; did you mean "{close[0]}"?' if close else listing


def _quantity(kind: Kind) -> Callable[[Any], float]:
    def check(value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, str | int | float):
            raise fault(f'expected {kind.name} like "{kind.example}"')
        try:
            number = parse_quantity(str(value), kind)
        except ValueError as error:
            raise fault(str(error)) from None
        if not LEAST <= number <= MOST:
            raise fault(f'"{value}" is out of range; {LEAST:g} to {MOST:g} {kind.unit} are allowed')
        return number

    return check


def _positive(kind: Kind) -> Any:
    schema = WithJsonSchema({"type": "string", "description": kind.name, "examples": [kind.example]})
    return Annotated[float, BeforeValidator(_quantity(kind)), schema]


def _as_tuple(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


def _tour(value: Any) -> Any:
    """A tour's name, or its labels as texts."""
    if not isinstance(value, list):
        if value not in TOURS:
            raise fault(f"{quoted(value)}; allowed: {nearest(value, TOURS, 'or a list of labels')}")
        return value
    if len(value) < 2:
        raise fault("a tour needs at least two labels")
    for label in value:
        if isinstance(label, bool) or not isinstance(label, str | int):
            raise fault(f"a label is a number or a text, not {label!r}")
    return tuple(str(label) for label in value)


def _quaternion(value: Any) -> Any:
    numbers = isinstance(value, list) and all(
        isinstance(v, int | float) and not isinstance(v, bool) for v in value
    )
    if not numbers or len(value) != 4:
        raise fault("expected a quaternion of four numbers [w, x, y, z]")
    norm = sum(float(v) ** 2 for v in value) ** 0.5
    if not abs(norm - 1) <= NORM_TOLERANCE:
        raise fault(f"{value} has norm {norm:.6g}; a unit quaternion [w, x, y, z] is needed")
    return tuple(float(v) for v in value)


Quaternion = Annotated[tuple[float, float, float, float], BeforeValidator(_quaternion)]


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Orientations(_Model):
    """Where the orientations come from: exactly one of the three."""

    lattice: LatticeName | None = None
    file: str | None = None
    list: Annotated[tuple[Quaternion, ...] | None, BeforeValidator(_as_tuple)] = None

    @model_validator(mode="after")
    def _one(self) -> Self:
        given = self.model_fields_set
        if len(given) != 1 or any(getattr(self, key) is None for key in given):
            raise fault('give exactly one of "lattice", "file", "list"')
        if self.list is not None and len(self.list) < 2:
            raise fault("a list needs at least two orientations")
        return self


class RouteModel(_Model):
    """Which orientations, in which order, and whether the body returns to the first."""

    orientations: Orientations
    tour: Annotated[TourName | tuple[str, ...], BeforeValidator(_tour)] = "given"
    closed: bool = False


class Limits(_Model):
    """Bounds on the norms of the body rates; each optional, at least one."""

    velocity: _positive(ANGULAR_VELOCITY) | None = None  # type: ignore[valid-type]
    acceleration: _positive(ANGULAR_ACCELERATION) | None = None  # type: ignore[valid-type]
    jerk: _positive(ANGULAR_JERK) | None = None  # type: ignore[valid-type]

    @model_validator(mode="after")
    def _some(self) -> Self:
        if not self.given():
            raise fault("at least one of velocity, acceleration, jerk must bound the motion")
        return self

    def given(self) -> dict[str, float]:
        """The limits that are set, by name, in SI."""
        return {name: value for name, value in self if value is not None}


class Nodes(_Model):
    """What holds at the nodes: how many time derivatives of the angle are continuous."""

    continuity: Literal[2, 3] = 2


class EasingModel(_Model):
    """The function family of the easing f(τ) on a leg."""

    basis: Literal["polynomial"] = "polynomial"
    degree: Annotated[int, Field(ge=5, le=MAX_DEGREE)] = 9


class Output(_Model):
    """How the law is sampled for `samples.csv`."""

    rate: _positive(FREQUENCY) = 100.0  # type: ignore[valid-type]


class Problem(_Model):
    """A problem file, version 1."""

    timelaw: Literal[1]
    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$", max_length=100)]
    route: RouteModel
    limits: Limits
    nodes: Nodes = Nodes()
    easing: EasingModel = EasingModel()
    objective: Literal["time"] = "time"
    baselines: Annotated[tuple[Baseline, ...], BeforeValidator(_as_tuple)] = ("quintic", "double-s")
    output: Output = Output()

    @model_validator(mode="after")
    def _degree_carries_continuity(self) -> Self:
        least = 2 * self.nodes.continuity + 1
        if self.easing.degree < least:
            raise fault(
                f"{self.easing.degree}; continuity {self.nodes.continuity} at the nodes needs "
                f"degree {least} or more",
                "easing",
                "degree",
            )
        return self
