"""Least time: the objective where nothing else is asked for."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from timelaw.easing import Timing
from timelaw.limits import Demand
from timelaw.objectives.effort import CALM
from timelaw.objectives.objective import Terms

TIE_WEIGHT = 1e-4  # of jerk against time, where given times leave room: of equally fast laws a calm one


@dataclass(frozen=True)
class LeastTime:
    """Σ T_k. Where given times leave the laws between them open, a little ∫|jerk|² picks a calm one."""

    name: ClassVar[str] = "time"
    words: ClassVar[str] = "total time"
    symbol: ClassVar[str] = "total time"
    unit: ClassVar[str] = "s"
    takes: ClassVar[tuple[str, ...]] = ()
    continuity: ClassVar[int] = 1
    needs_inertia: ClassVar[bool] = False
    separable: ClassVar[bool] = True
    scales_limits: ClassVar[bool] = False

    def measure(self, demands: Sequence[Demand], timings: Sequence[Timing]) -> float:  # noqa: ARG002
        """Σ T_k [s]."""
        return sum(timing.duration for timing in timings)

    def scale(self, demands: Sequence[Demand], start: Sequence[Timing]) -> float:
        """The jerk of the start, for the choice among equally fast laws."""
        return CALM.measure(demands, start)

    def expression(self, terms: Terms) -> Any:
        """The time, and where it cannot be stretched, 1e-4 of jerk beside it."""
        if terms.elastic or not terms.scale:
            return terms.time
        return terms.time + TIE_WEIGHT * terms.legs * terms.effort(CALM.name)
