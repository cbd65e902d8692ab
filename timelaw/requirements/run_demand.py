"""What must hold over a run, and the least time that physics allows it."""

from dataclasses import dataclass
from functools import cached_property

from timelaw.least_time.physical_limit import run_limit
from timelaw.limits import Demand


@dataclass(frozen=True)
class RunDemand:
    """The demands of the legs of a run; the rates φ', φ'', … at its ends, none for rest."""

    legs: tuple[Demand, ...]
    start: tuple[float, ...] = ()
    end: tuple[float, ...] = ()

    @property
    def moving(self) -> bool:
        """Whether it is entered or left at speed."""
        return any(self.start) or any(self.end)

    @property
    def elastic(self) -> bool:
        """Whether stretching time leaves everything true but the times."""
        return not self.moving and all(leg.duration is None for leg in self.legs)

    @cached_property
    def limit(self) -> float:
        """A time [s] that no motion over it beats."""
        return run_limit(self.legs, moving=self.moving)

    def key(self) -> tuple[object, ...]:
        """Equal for runs that have equal solutions."""
        return (tuple(leg.key() for leg in self.legs), self.start, self.end)
