"""The part of a problem file about the objective: least time, or something else in a time that is given."""

from dataclasses import dataclass
from typing import Annotated, Any, Self

from pydantic import BeforeValidator, Field, WithJsonSchema, model_validator

from timelaw.objectives import OBJECTIVES
from timelaw.problem.fields import Model, fault, one_of, quote, read_quantity
from timelaw.units import MOST, TIME

RELATIVE = " x minimum"


@dataclass(frozen=True)
class TotalTime:
    """A total time in s, or as a multiple of the least one."""

    value: float
    relative: bool = False

    def seconds(self, least: float) -> float:
        """In s, where `least` is the least time."""
        return self.value * least if self.relative else self.value


def _total_time(value: Any) -> TotalTime:
    """A time, or "1.5 x minimum"."""
    if isinstance(value, TotalTime):
        return value
    if not (isinstance(value, str) and value.endswith(RELATIVE)):
        return TotalTime(read_quantity(value, TIME))
    try:
        factor = float(value.removesuffix(RELATIVE))
    except ValueError:
        factor = 0.0
    if not 1 <= factor <= MOST:
        raise fault(f'"{value}"; a factor of at least 1 is needed, as in "1.5 x minimum"')
    return TotalTime(factor, relative=True)


class Goal(Model):
    """What is made least. All but time need a total time, or a weight against time.

    With `weight` c the sum T/T* + c E/E* is made least, T* and E* being time and effort of the
    least-time law, so that c compares relative changes.
    """

    minimise: Annotated[str, one_of(OBJECTIVES)] = "time"
    total_time: Annotated[
        TotalTime | None,
        BeforeValidator(_total_time),
        WithJsonSchema({"type": "string", "examples": ["60 s", "1.5 x minimum"]}),
    ] = None
    weight: Annotated[float, Field(gt=0, le=1e6)] | None = None

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        given = [name for name in ("total_time", "weight") if getattr(self, name) is not None]
        takes = OBJECTIVES[self.minimise].takes
        if not takes and given:
            *others, last = [name for name, objective in OBJECTIVES.items() if objective.takes]
            listing = f"{', '.join(others)} or {last}"
            raise fault(f"least {self.minimise} leaves no room for {given[0]}; minimise {listing}")
        if any(key not in takes for key in given):
            raise fault(f"{self.minimise} is made least in a given total_time, not against a weight")
        if takes and len(given) != 1:
            keys = " or ".join(f'"{key}"' for key in takes)
            either = "either " if len(takes) > 1 else ""
            raise fault(f"to minimise {self.minimise}, give {either}{keys}")
        return self


def read_goal(value: Any) -> Any:
    """The one word "time", or a mapping."""
    if value == "time":
        return Goal()
    if not isinstance(value, dict):
        raise fault(f"{quote(value)}; allowed: time, or a mapping like {{minimise: jerk, total_time: 60 s}}")
    return value
