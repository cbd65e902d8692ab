"""What comes back from the solver, in this program's own words."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from timelaw.easing import Timing
from timelaw.nlp.verdicts import Verdict

GAP = 1e-6  # relative: what the limits between the points may still cost, in time or in their used part


class Status(Enum):
    """How a program was solved; the text says what to do about it."""

    OPTIMAL = "solved to optimality"
    CHOSEN = "the double-S profile, as chosen"
    PHYSICAL_LIMIT = "the double-S profile, which the easing contains and no law beats"
    STEADY = "a steady turn, which starts and ends as it goes on"
    BEYOND = "no law on the arcs themselves holds the limits: the body runs beyond a node and comes back"
    SECOND_START = "solved to optimality from the second start"
    SIMPLER = "solved from the solution of a simpler easing, after other starts failed"
    GAP_LEFT = (
        "the rounds ended before what the limits still cost was small: the law holds its limits, but may be "
        "from the optimum by as much as its gap; try another easing"
    )
    STOPPED = (
        "stopped early by the time limit: the best law found by then is used; it holds the limits, but may "
        "not be least; give more time with --time-limit"
    )
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
    AT_MINIMUM = "the least-time law: the given time leaves room for no other"
    STOPS = (
        "the solver failed from every start: a law that stops at every node is used, stretched to the given "
        "times; try another easing"
    )
    CLOSED_FORM = (
        "the solver failed from every start: the best law in closed form is used; try another easing"
    )


@dataclass(frozen=True)
class Solution:
    """Timings of the legs that hold the limits, and how they were found.

    `rounds` counts solutions of the nonlinear program: after each, the extrema that exceed a
    limit are demanded too. `gap` is what those cost at the end, relative in time for least time,
    else in the part of the limits that is used. `failures` are the solver's verdicts where it failed.
    """

    timings: tuple[Timing, ...]
    status: Status
    iterations: int = 0
    rounds: int = 0
    gap: float = 0.0
    rows: int = 0
    failures: tuple[Verdict, ...] = ()

    def describe(self) -> str:
        """How it was found, and where the solver failed its verdicts, with what to do."""
        verdicts = [f"{verdict.value}: {verdict.remedy}" for verdict in dict.fromkeys(self.failures)]
        return "; IPOPT: ".join([self.status.value, *verdicts])

    @property
    def duration(self) -> float:
        """Total time of the legs [s]."""
        return sum_durations(self.timings)


@dataclass(frozen=True)
class Timings:
    """Timings of all legs, the solutions behind them, and which of these each run of the route uses.

    A coupled problem has one solution for all runs.
    """

    timings: tuple[Timing, ...]
    solutions: tuple[Solution, ...]
    of_run: tuple[int, ...]

    @property
    def stopped_early(self) -> bool:
        """Whether the time limit ended the search for any of them."""
        return any(solution.status is Status.STOPPED for solution in self.solutions)


def sum_durations(timings: Sequence[Timing]) -> float:
    """Σ T_k [s]."""
    return sum(timing.duration for timing in timings)
