"""The optimised time law: the solutions of the distinct runs, laid along the route."""

from timelaw.nlp import Optimised
from timelaw.time_law.time_law import TimeLaw


def optimised(solution: Optimised) -> TimeLaw:
    """One timing per leg, in the order of the route."""
    timings = [timing for index in solution.of_run for timing in solution.solutions[index].timings]
    return TimeLaw("optimised", tuple(timings))
