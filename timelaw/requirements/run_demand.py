"""What must hold over a run, and the least time that physics allows it."""

from dataclasses import dataclass
from functools import cached_property

from timelaw.least_time.physical_limit import run_limit
from timelaw.limits import Demand


@dataclass(frozen=True)
class RunDemand:
    """The demands of the legs of a run; the rates φ', φ'', … at its ends, none for rest.

    `where` is the key of the problem file to be named where no law does all that.
    """

    demands: tuple[Demand, ...]
    start: tuple[float, ...] = ()
    end: tuple[float, ...] = ()
    where: str = ""

    @property
    def moving(self) -> bool:
        """Whether it is entered or left at speed."""
        return any(self.start) or any(self.end)

    @property
    def angle(self) -> float:
        """Of all its legs [rad]."""
        return sum(demand.angle for demand in self.demands)

    @property
    def speeds(self) -> tuple[float, float]:
        """φ' [rad/s] at its ends."""
        return (*self.start, 0.0)[0], (*self.end, 0.0)[0]

    @property
    def elastic(self) -> bool:
        """Whether stretching time leaves everything true but the times."""
        return not self.moving and all(demand.duration is None for demand in self.demands)

    @cached_property
    def limit(self) -> float:
        """A time [s] that no motion over it beats."""
        return run_limit(self.demands, self.speeds if self.moving else None)

    def key(self) -> tuple[object, ...]:
        """Equal for runs that have equal solutions."""
        return (tuple(demand.key() for demand in self.demands), self.start, self.end)
