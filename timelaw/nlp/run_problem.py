"""What is asked for one run, and what comes back."""

from dataclasses import dataclass
from enum import Enum

from timelaw.easing import PolynomialBasis, Timing
from timelaw.limits import Rate


@dataclass(frozen=True)
class RunProblem:
    """A run from rest to rest over legs of the given `angles` [rad], about one axis."""

    angles: tuple[float, ...]
    limits: tuple[Rate, ...]
    basis: PolynomialBasis
    objective: str = "time"


class Status(Enum):
    """How a run was solved; the text says what to do about it."""

    OPTIMAL = "solved to optimality"
    SECOND_START = "solved to optimality from the second start"
    ACCEPTABLE = (
        "solved to the solver's acceptable tolerance only; the law holds its limits, but may not be least"
    )
    CLOSED_FORM = (
        "the solver failed from every start: the smoothstep over the run is used; try another easing degree"
    )


@dataclass(frozen=True)
class RunSolution:
    """Timings of the legs that hold the limits, and how they were found.

    `rounds` counts solutions of the nonlinear program: after each, the extrema that exceed a
    limit are demanded too. `bound` [s] is the optimum of the last program, which demands the
    limits only at points: the law itself, stretched to hold them everywhere, takes longer by the
    `gap`.
    """

    timings: tuple[Timing, ...]
    status: Status
    iterations: int = 0
    rounds: int = 0
    bound: float = 0.0
    rows: int = 0

    @property
    def duration(self) -> float:
        """Total time [s]."""
        return sum(timing.duration for timing in self.timings)

    @property
    def gap(self) -> float:
        """(duration - bound)/bound, how much the limits between the points still cost."""
        return self.duration / self.bound - 1
