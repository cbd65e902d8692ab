"""The optimised time law: the timings of the solver, with the dwells of the schedule."""

from timelaw.nlp import Optimised
from timelaw.schedule import Schedule
from timelaw.time_law.time_law import TimeLaw


def optimised(solution: Optimised, schedule: Schedule) -> TimeLaw:
    """One timing per leg, in the order of the route."""
    return TimeLaw("optimised", solution.timings, schedule.dwells)
