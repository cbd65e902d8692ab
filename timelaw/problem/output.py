"""The part of a problem file about what is written: the rate of samples, and the control cycle."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

from timelaw.problem.fields import Model, fault, quantity
from timelaw.units import FREQUENCY, TIME

if TYPE_CHECKING:
    from timelaw.problem.problem import Problem

FINEST, COARSEST = 1e-6, 1e3  # s; of control cycles


class Output(Model):
    """Samples per second in `samples.csv`; with a `grid` the motion ends on a multiple of that time."""

    rate: Annotated[float, quantity(FREQUENCY)] = 100.0
    grid: Annotated[float | None, quantity(TIME, FINEST, COARSEST)] = None


def find_given_times(problem: "Problem") -> Iterator[str]:
    """The keys of a problem that fix times, or rates at its ends, which no stretch would keep."""
    nodes = problem.nodes
    if problem.objective.total_time is not None:
        yield "objective.total_time"
    yield from (f"nodes.at.{label}.time" for label, rule in nodes.at.items() if rule.time is not None)
    yield from (f"segments.{leg}.duration" for leg, rule in problem.segments.items() if rule.duration)
    for name, rates in (("start", nodes.moving_start), ("end", nodes.end)):
        if rates and any(rate for rate in rates.rates(4) if rate != (0.0, 0.0, 0.0)):
            yield f"nodes.{name}"


def refuse_grid(problem: "Problem") -> None:
    """Say why a motion with given times cannot be stretched to a multiple of a control cycle."""
    given = next(find_given_times(problem), None) if problem.output.grid is not None else None
    if given is not None:
        message = f"the motion would be stretched to a multiple of it, and no longer keep {given}"
        raise fault(f"{message}; give one of them", "output", "grid")
