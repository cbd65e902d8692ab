"""The words that law files are made of: numbers and vectors in the ranges in which they make sense."""

from math import pi
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field

from timelaw.files import LONGEST_LABEL
from timelaw.units import LEAST, MOST

SHORTEST, LONGEST = 1e-9, 1e12  # s; cubes and fourth powers of times stay far from overflow
BRIEFEST = 1e-30  # s; a piece of a segment, which may be as short as limits are apart
NARROWEST = 1e-12  # rad; angle of a leg
WIDEST = 1e60  # of a rate; squares of what follows from such numbers stay far from overflow
HEAVIEST = 1e30  # of a moment of inertia [kg·m²], or a momentum [N·m·s]
MOST_KEYS = 100  # of limits and conventions, of which there are a dozen
LARGEST_ANGLE = 2 * pi  # rad; half a turn, and more where it is one within the precision of its nodes

Number = Annotated[float, Field(allow_inf_nan=False)]
Control = Annotated[float, Field(ge=-WIDEST, le=WIDEST)]
Duration = Annotated[float, Field(ge=SHORTEST, le=LONGEST)]
Vector3 = Annotated[list[Number], Field(min_length=3, max_length=3)]
Moderate3 = Annotated[  # a row of an inertia, a momentum
    list[Annotated[float, Field(ge=-HEAVIEST, le=HEAVIEST)]], Field(min_length=3, max_length=3)
]
Vector4 = Annotated[list[Number], Field(min_length=4, max_length=4)]
BoundsDocument = Annotated[
    dict[str, Annotated[Any, AfterValidator(lambda value: _bound(value))]],
    BeforeValidator(lambda value: refuse_many(value)),
]
Text = Annotated[str, Field(max_length=LONGEST_LABEL)]


def _bound(value: Any) -> Any:
    """A positive number, or three of them."""
    numbers = value if isinstance(value, list) and len(value) == 3 else [value]
    for number in numbers:
        plain = isinstance(number, int | float) and not isinstance(number, bool)
        if not (plain and LEAST**2 <= number <= MOST**2):
            raise ValueError("a positive number, or three for the body axes, is needed")
    return value


def refuse_many(value: Any) -> Any:
    """A mapping of few keys, before each of them is looked at and found wrong."""
    if isinstance(value, dict) and len(value) > MOST_KEYS:
        raise ValueError(f"{len(value)} keys; at most {MOST_KEYS} are allowed")
    return value


class Part(BaseModel):
    """Unknown keys are left alone: a later version may write more."""

    model_config = ConfigDict(
        strict=True, extra="ignore", defer_build=True
    )  # of all at once, when one is read
