"""Least peak: the part of the limits that is used, as small as a given time allows."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from timelaw.easing import Timing
from timelaw.easing.time_scaling import used_fraction
from timelaw.limits import Demand
from timelaw.objectives.objective import Terms


@dataclass(frozen=True)
class LeastPeak:
    """p = max over limits and time of quantity/limit: in T it is the p under whose limits T is least."""

    name: ClassVar[str] = "peak"
    words: ClassVar[str] = "used part of the limits"
    symbol: ClassVar[str] = "largest part of a limit that is used"
    unit: ClassVar[str] = ""
    takes: ClassVar[tuple[str, ...]] = ("total_time",)
    continuity: ClassVar[int] = 1
    needs_inertia: ClassVar[bool] = False
    separable: ClassVar[bool] = False
    scales_limits: ClassVar[bool] = True

    def measure(self, demands: Sequence[Demand], timings: Sequence[Timing]) -> float:
        """p, proved."""
        return used_fraction(demands, timings)

    def scale(self, demands: Sequence[Demand], start: Sequence[Timing]) -> float:
        """The part that the start uses."""
        return used_fraction(demands, start) or 1.0

    def expression(self, terms: Terms) -> Any:
        """The variable p."""
        return terms.used_part
