"""The parts of a problem file about single nodes and legs: stops, dwells, times, slower stretches."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from timelaw.problem.fields import Model, fault, quantity
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


class EndRates(Model):
    """Rates about the first or last leg's axis where the motion begins or ends moving."""

    velocity: Annotated[float, quantity(ANGULAR_VELOCITY, 0.0)] = 0.0
    acceleration: Annotated[float, quantity(ANGULAR_ACCELERATION, -MOST)] = 0.0
    jerk: Annotated[float, quantity(ANGULAR_JERK, -MOST)] = 0.0

    def rates(self, continuity: int) -> tuple[float, ...]:
        """φ', φ'', … up to the order that is continuous."""
        return (self.velocity, self.acceleration, self.jerk, 0.0)[:continuity]


class Nodes(Model):
    """Continuity for all nodes, dwells for all, and rules for single ones by label."""

    continuity: Literal[1, 2, 3, 4] = 2
    dwell: Annotated[float, DWELL] = 0.0
    at: dict[str, NodeRule] = Field(default_factory=dict)
    start: EndRates | None = None
    end: EndRates | None = None


class SegmentRule(Model):
    """What holds on one leg: limits besides the general ones, a fixed duration."""

    duration: Annotated[float | None, INSTANT] = None
    limits: Limits | None = None

    @model_validator(mode="after")
    def _some(self) -> Self:
        if self.duration is None and self.limits is None:
            raise fault('give "duration", "limits" or both')
        return self
