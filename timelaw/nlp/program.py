"""What is asked of the solver."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf, pi
from typing import TypeVar

from timelaw.easing.family import Basis, Family
from timelaw.limits import Demand
from timelaw.objectives import OBJECTIVES, Objective
from timelaw.requirements.given_times import Budget
from timelaw.requirements.run_demand import RunDemand

FARTHEST = pi  # rad: how far the body runs beyond a leg at most, where no law stays on the arcs
LARGE = 300  # coefficients: beyond, a solution takes seconds, and a failure a minute
MARGIN = 2e-6  # of every limit; what is left between the points, and rounding, fit into it
T = TypeVar("T")
LEAST_TIME, LEAST_PEAK = OBJECTIVES["time"], OBJECTIVES["peak"]


@dataclass(frozen=True)
class RunProblem:
    """A run over legs about one axis, with easings of a family.

    `start` and `end` are its rates φ', φ'', … there, empty for rest; `where` is the key of the problem
    file that says what is hard about it.
    """

    demands: tuple[Demand, ...]
    family: Family
    start: tuple[float, ...] = ()
    end: tuple[float, ...] = ()
    where: str = ""

    @cached_property
    def run(self) -> RunDemand:
        """What must hold, whatever the easing."""
        return RunDemand(self.demands, self.start, self.end)

    @property
    def elastic(self) -> bool:
        """Whether stretching time leaves everything true but the times."""
        return self.run.elastic

    @cached_property
    def bases(self) -> tuple[Basis, ...]:
        """The basis of each leg."""
        return self.family.bases(self.demands)

    def key(self) -> tuple[object, ...]:
        """Equal for runs that have equal solutions."""
        return self.run.key()


@dataclass(frozen=True)
class Program:
    """Runs to be solved together: an objective, and times that are given.

    With `weight` the objective is added to the time: T/T* + weight E/E*, T* and E* those of the start.
    Where time cannot be stretched, a `margin` is kept from every limit, and the body runs at most so far
    `beyond` a node of its leg [rad], to come back. `counts` says how many times each run is made, once each
    if empty: alike runs are moved through alike.
    """

    runs: tuple[RunProblem, ...]
    objective: Objective = LEAST_TIME
    weight: float | None = None
    budgets: tuple[Budget, ...] = ()
    beyond: float = 0.0
    margin: float = MARGIN
    counts: tuple[int, ...] = ()

    @property
    def demands(self) -> tuple[Demand, ...]:
        """Demands of all legs, run after run."""
        return tuple(demand for run in self.runs for demand in run.demands)

    @property
    def bases(self) -> tuple[Basis, ...]:
        """Bases of all legs, run after run."""
        return tuple(basis for run in self.runs for basis in run.bases)

    @property
    def leg_counts(self) -> tuple[int, ...]:
        """How many times each leg is made."""
        counts = self.counts or (1,) * len(self.runs)
        return tuple(count for run, count in zip(self.runs, counts, strict=True) for _ in run.demands)

    def repeat(self, legs: Sequence[T]) -> list[T]:
        """Something for each leg as many times as the leg is made."""
        return [leg for leg, count in zip(legs, self.leg_counts, strict=True) for _ in range(count)]

    @property
    def moving(self) -> bool:
        """Whether the motion begins or ends at speed."""
        return any(run.run.moving for run in self.runs)

    @property
    def straying(self) -> list[bool]:
        """For each leg whether the body might run beyond it: in moving runs, where legs of one have times."""
        found: list[bool] = []
        for run in self.runs:
            first, last = len(found), len(found) + len(run.demands)
            inside = any(first < budget.legs < last for budget in self.budgets)
            fixed = last - first > 1 and any(demand.duration is not None for demand in run.demands)
            strays = self.beyond < inf and (run.run.moving or inside or fixed)
            found += [strays] * (last - first)
        return found

    @property
    def elastic(self) -> bool:
        """Whether the last excess over a limit may be closed by stretching time."""
        return self.objective.separable and not self.budgets and all(run.elastic for run in self.runs)

    @property
    def large(self) -> bool:
        """Whether it takes so long to solve that it is not tried from everywhere."""
        return sum(basis.free for basis in self.bases) > LARGE

    @property
    def divided(self) -> bool:
        """Whether a time is given for a part of the legs."""
        return any(budget.legs != len(self.demands) for budget in self.budgets)
