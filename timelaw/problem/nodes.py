"""The parts of a problem file about single nodes and legs: stops, dwells, times, slower stretches."""

from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from timelaw.problem.fields import Model, about_axis_or_body, fault, quantity
from timelaw.problem.limits import Limits
from timelaw.units import ANGULAR_ACCELERATION, ANGULAR_JERK, ANGULAR_VELOCITY, MOST, TIME

DWELL = quantity(TIME, 0.0)
INSTANT = quantity(TIME)


class NodeRule(Model):
    """What holds at one node: a dwell at rest, a forced stop, the time of arrival.

    `limits` hold on the legs that meet at the node, besides the general ones.
    """

    dwell: Annotated[float | None, DWELL] = None
    stop: bool = False
    time: Annotated[float | None, INSTANT] = None
    limits: Limits | None = None


Three = tuple[float, float, float]


class EndRates(Model):
    """Rates where the motion begins or ends moving: about the first or last leg's axis, or in body axes.

    `periodic`: a closed tour that goes round begins as it ends, moving as is best.
    """

    velocity: Annotated[float | Three, about_axis_or_body(ANGULAR_VELOCITY, 0.0)] = 0.0
    acceleration: Annotated[float | Three, about_axis_or_body(ANGULAR_ACCELERATION, -MOST)] = 0.0
    jerk: Annotated[float | Three, about_axis_or_body(ANGULAR_JERK, -MOST)] = 0.0
    periodic: bool = False

    @model_validator(mode="after")
    def _one_or_other(self) -> Self:
        if self.periodic and self.model_fields_set != {"periodic"}:
            raise fault("a tour that goes round begins with the rates that it ends with; give no others")
        return self

    @property
    def in_body_axes(self) -> tuple[str, ...]:
        """The keys that are given by three components."""
        given = {"velocity": self.velocity, "acceleration": self.acceleration, "jerk": self.jerk}
        return tuple(key for key, value in given.items() if isinstance(value, tuple))

    def rates(self, continuity: int) -> tuple[float | Three, ...]:
        """φ', φ'', … up to the order that is continuous."""
        return (self.velocity, self.acceleration, self.jerk, 0.0)[:continuity]


class Nodes(Model):
    """Continuity for all nodes, dwells for all, and rules for single ones by label."""

    continuity: Literal[1, 2, 3, 4] = 2
    dwell: Annotated[float, DWELL] = 0.0
    at: dict[str, NodeRule] = Field(default_factory=dict)
    start: Annotated[EndRates | None, BeforeValidator(lambda value: _read_periodic(value))] = None
    end: EndRates | None = None

    @property
    def periodic(self) -> bool:
        """Whether a closed tour goes round and round."""
        return self.start is not None and self.start.periodic

    @property
    def moving_start(self) -> EndRates | None:
        """The rates with which the motion begins, None for rest and for a tour that goes round."""
        return None if self.periodic else self.start

    @model_validator(mode="after")
    def _go_round_both(self) -> Self:
        if self.periodic and self.end is not None:
            raise fault('a tour that goes round has no end; leave "end" away', "end")
        if self.end is not None and self.end.periodic:
            raise fault('"periodic" belongs to the start', "end", "periodic")
        return self


def _read_periodic(value: Any) -> Any:
    """The one word "periodic", or a mapping."""
    return {"periodic": True} if value == "periodic" else value


class SegmentRule(Model):
    """What holds on one leg: limits besides the general ones, a fixed duration."""

    duration: Annotated[float | None, INSTANT] = None
    limits: Limits | None = None

    @model_validator(mode="after")
    def _some(self) -> Self:
        if self.duration is None and self.limits is None:
            raise fault('give "duration", "limits" or both')
        return self
