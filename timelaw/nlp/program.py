"""What is asked of the solver, and what comes back."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property

from timelaw.easing import Timing
from timelaw.easing.family import Basis, Family
from timelaw.limits import Demand


@dataclass(frozen=True)
class RunProblem:
    """A run over legs about one axis, with easings of a family.

    `start` and `end` are its rates φ', φ'', … there, empty for rest.
    """

    demands: tuple[Demand, ...]
    family: Family
    start: tuple[float, ...] = ()
    end: tuple[float, ...] = ()

    @property
    def elastic(self) -> bool:
        """Whether stretching time leaves everything true but the times."""
        fixed = any(demand.duration is not None for demand in self.demands)
        return not fixed and not any(self.start) and not any(self.end)

    @cached_property
    def bases(self) -> tuple[Basis, ...]:
        """The basis of each leg."""
        return self.family.bases(self.demands)

    def key(self) -> tuple[object, ...]:
        """Equal for runs that have equal solutions."""
        return (tuple(demand.key() for demand in self.demands), self.start, self.end)


@dataclass(frozen=True)
class Budget:
    """The first `legs` legs of the program together take `time` [s]."""

    legs: int
    time: float


@dataclass(frozen=True)
class Program:
    """Runs to be solved together: an objective by its key, and times that are given.

    With `weight` the objective is added to the time: T/T* + weight E/E*, T* and E* those of the
    start. `margin` is kept from every limit where time cannot be stretched afterwards.
    """

    runs: tuple[RunProblem, ...]
    objective: str = "time"
    weight: float | None = None
    budgets: tuple[Budget, ...] = ()

    @property
    def demands(self) -> tuple[Demand, ...]:
        """Demands of all legs, run after run."""
        return tuple(demand for run in self.runs for demand in run.demands)

    @property
    def bases(self) -> tuple[Basis, ...]:
        """Bases of all legs, run after run."""
        return tuple(basis for run in self.runs for basis in run.bases)

    @property
    def elastic(self) -> bool:
        """Whether the last excess over a limit may be closed by stretching time."""
        return self.objective == "time" and not self.budgets and all(run.elastic for run in self.runs)


class Status(Enum):
    """How a program was solved; the text says what to do about it."""

    OPTIMAL = "solved to optimality"
    CHOSEN = "the double-S profile, as chosen"
    PHYSICAL_LIMIT = "the double-S profile, which the easing contains and no law beats"
    SECOND_START = "solved to optimality from the second start"
    SIMPLER = "solved from the solution of a simpler easing, after other starts failed"
    STRETCHED = (
        "the solver failed on the objective: the least-time law, stretched to the given times, is used; "
        "try another easing"
    )
    ACCEPTABLE = (
        "solved to the solver's acceptable tolerance only; the law holds its limits, but may not be least"
    )
    LEAST_PEAK = (
        "the solver failed on the objective: the law that uses the least part of the limits is used; "
        "try another easing degree or more time"
    )
    CLOSED_FORM = (
        "the solver failed from every start: the best law in closed form is used; try another easing"
    )


@dataclass(frozen=True)
class Solution:
    """Timings of the legs that hold the limits, and how they were found.

    `rounds` counts solutions of the nonlinear program: after each, the extrema that exceed a
    limit are demanded too. `gap` is what those cost at the end, relative in time for least time,
    else in the part of the limits that is used.
    """

    timings: tuple[Timing, ...]
    status: Status
    iterations: int = 0
    rounds: int = 0
    gap: float = 0.0
    rows: int = 0

    @property
    def duration(self) -> float:
        """Total time of the legs [s]."""
        return total(self.timings)


def total(timings: Sequence[Timing]) -> float:
    """Σ T_k [s]."""
    return sum(timing.duration for timing in timings)
