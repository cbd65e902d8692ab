"""Times that are given: of arrival at nodes, and in all."""

from collections.abc import Sequence
from dataclasses import dataclass

from timelaw.easing import Timing
from timelaw.requirements.requirements import Requirements

LAST_DIGIT = 1e-11  # relative; a least time that is given to its last digit is not undercut


@dataclass(frozen=True)
class Budget:
    """The first `legs` legs of the motion together take `time` [s], dwells apart."""

    legs: int
    time: float


def find_stretch(time: float, needed: float) -> float:
    """The factor from one time to another; 1 where what is given is what is needed but for rounding."""
    factor = time / needed
    return 1.0 if 1 - LAST_DIGIT <= factor < 1 else factor


def list_budgets(requirements: Requirements, total: float | None = None) -> list[Budget]:
    """Arrival times, and the `total` of all legs if it is given, as times of legs alone."""
    found = [
        Budget(node, time - sum(requirements.dwells[:node]))
        for node, time in sorted(requirements.arrivals.items())
    ]
    return found if total is None else [*found, Budget(len(requirements.demands), total)]


def meet_budgets(
    timings: Sequence[Timing], elastic: Sequence[bool], budgets: Sequence[Budget]
) -> tuple[Timing, ...]:
    """Legs between two given times stretched by one factor, but for those that are not elastic.

    `budgets` stand in the order of the route; what comes after the last one stays as it is.
    """
    met: list[Timing] = []
    passed = 0.0
    for budget in budgets:
        part = list(zip(timings, elastic, strict=True))[len(met) : budget.legs]
        free = sum(timing.duration for timing, may in part if may)
        rest = sum(timing.duration for timing, may in part if not may)
        factor = find_stretch(budget.time - passed - rest, free) if free else 1.0
        met += [timing.stretched(factor) if may else timing for timing, may in part]
        passed = budget.time
    return (*met, *timings[len(met) :])
