"""Values in a problem file: how each is read, and what is said of one that is wrong."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from math import isfinite
from typing import Any

from pydantic import BaseModel, ConfigDict
from pydantic_core import PydanticCustomError, core_schema

from timelaw.errors import shorten
from timelaw.units import LEAST, MOST, Kind, parse_quantity

NORM_TOLERANCE = 1e-3  # a quaternion typed with four digits still counts as a unit quaternion


class Model(BaseModel):
    """A mapping of a problem file: unknown keys are faults, nothing is converted silently."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


def fault(message: str, *where: str | int) -> PydanticCustomError:
    """A validation error whose text is shown to the user as it stands, at `where` below its model."""
    return PydanticCustomError("timelaw", "{message}", {"message": message, "where": where})


def quote(value: Any) -> str:
    """A value as a message shows it; a long one is shortened."""
    if isinstance(value, bool) or value is None:
        return {None: "null", True: "true", False: "false"}[value]
    return f'"{shorten(value)}"' if isinstance(value, str) else shorten(f"{value}")


def suggest(given: Any, allowed: Iterable[str], *others: str) -> str:
    """The allowed values as a text, the likeliest name pointed out."""
    names = list(allowed)
    close = get_close_matches(str(given), names, n=1, cutoff=0.6)
    listing = ", ".join([*names, *others])
    return f'{listing}; did you mean "{close[0]}"?' if close else listing


def read_quantity(value: Any, kind: Kind, least: float = LEAST, most: float = MOST) -> float:
    """A number with its unit, in SI, between `least` and `most`."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise fault(f'expected {kind.name} like "{kind.example}"')
    try:
        number = parse_quantity(str(value), kind)
    except ValueError as error:
        raise fault(str(error)) from None
    if not least <= number <= most:
        raise fault(f'"{shorten(str(value))}" is out of range; {least:g} to {most:g} {kind.unit} are allowed')
    return number


@dataclass(frozen=True)
class Reader:
    """Metadata of an annotated field: how its value is read, and how the schema describes it."""

    read: Callable[[Any], Any]
    kind: Kind

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        """Read before the type is checked."""
        return core_schema.no_info_before_validator_function(self.read, handler(source))

    def __get_pydantic_json_schema__(self, *_: Any) -> dict[str, Any]:
        """A text with a unit."""
        return {"type": "string", "description": self.kind.name, "examples": [self.kind.example]}


def quantity(kind: Kind, least: float = LEAST, most: float = MOST) -> Reader:
    """For a field that holds one quantity; `least` 0 or below allows zero and negative values."""
    return Reader(lambda value: read_quantity(value, kind, least, most), kind)


def percentage() -> Reader:
    """For a field that holds a small part of something, written as "1 %" or as a number below 1."""

    def check(value: Any) -> float:
        text = str(value).strip()
        try:
            number = float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
        except ValueError:
            number = 0.0
        if isinstance(value, bool) or not 1e-5 <= number < 1:
            raise fault(f'{quote(value)}; a part from 0.001 % to less than 100 % is needed, like "1 %"')
        return number

    return Reader(check, Kind("a part of a whole", (0, 0, 0, 0), "1 %", "1"))


@dataclass(frozen=True)
class Choice:
    """Metadata of a field that names an entry of a registry."""

    names: tuple[str, ...]

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        """One of the names."""
        return core_schema.no_info_before_validator_function(self._check, handler(source))

    def _check(self, value: Any) -> Any:
        if value not in self.names:
            raise fault(f"{quote(value)}; allowed: {suggest(value, self.names)}")
        return value

    def __get_pydantic_json_schema__(self, *_: Any) -> dict[str, Any]:
        """An enumeration."""
        return {"type": "string", "enum": list(self.names)}


def one_of(registry: Iterable[str]) -> Choice:
    """For a field that names an entry of a registry."""
    return Choice(tuple(registry))


FREE = ("null", "none", "nan", "inf", "infinity", "free", "unlimited", "~", "-", "")


def _is_free(value: Any) -> bool:
    """Whether a value says that there is no limit, with a unit or without."""
    if value is None or (isinstance(value, float) and not isfinite(value)):
        return True
    word = value.strip().lstrip("+-.").split(maxsplit=1) if isinstance(value, str) else None
    return word == [] or (word is not None and word[0].lower() in FREE)


def bounds(kind: Kind) -> Reader:
    """For a field that holds a bound on a norm, or a list of three for the body axes."""

    def check(value: Any) -> Any:
        if not isinstance(value, list):
            if _is_free(value):
                raise fault(f"{quote(value)}; leave the key away where there is no limit")
            return read_quantity(value, kind)
        if len(value) != 3:
            raise fault(f"{len(value)} values; one for the norm or three for the body axes are needed")
        for free in filter(_is_free, value):
            large = f"1e6 {kind.example.split(maxsplit=1)[1]}"
            raise fault(f'{quote(free)}; give an axis without a limit a large one, such as "{large}"')
        return tuple(read_quantity(v, kind) for v in value)

    return Reader(check, kind)


def about_axis_or_body(kind: Kind, least: float) -> Reader:
    """For a field that holds a rate about an axis that is known, or a list of three in body axes."""

    def check(value: Any) -> Any:
        if not isinstance(value, list):
            return read_quantity(value, kind, least)
        if len(value) != 3:
            raise fault(f"{len(value)} values; one about the leg's axis or three in body axes are needed")
        return tuple(0.0 if v == 0 else read_quantity(v, kind, -MOST) for v in value)

    return Reader(check, kind)


def as_tuple(value: Any) -> Any:
    """A YAML list as the tuple a frozen model holds."""
    return tuple(value) if isinstance(value, list) else value


def tour_or_labels(names: tuple[str, ...]) -> Callable[[Any], Any]:
    """A tour's name, or its labels as texts."""

    def check(value: Any) -> Any:
        if not isinstance(value, list):
            if value not in names:
                raise fault(f"{quote(value)}; allowed: {suggest(value, names, 'or a list of labels')}")
            return value
        if len(value) < 2:
            raise fault("a tour needs at least two labels")
        for label in value:
            if isinstance(label, bool) or not isinstance(label, str | int):
                raise fault(
                    f"a label is a number or a text, not {shorten(repr(label))}; a text may need quotes"
                )
        return tuple(str(label) for label in value)

    return check
