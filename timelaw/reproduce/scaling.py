"""How the time of a coupled solution grows: `python -m timelaw.reproduce.scaling [LARGEST]`.

Legs of different angles, every one from stop to stop, least jerk in 1.3 times the least time: one
sparse nonlinear program over all. Prints a Markdown table of seconds, and what it was measured on.
"""

import os
import platform
import time
from collections.abc import Sequence

import numpy as np

from timelaw.easing.family import PolynomialFamily
from timelaw.limits import Demand, drop_implied, list_rows, make_limits
from timelaw.nlp import RunProblem
from timelaw.nlp.all_runs import Deadline, solve_together
from timelaw.nlp.single_runs import solve_runs
from timelaw.nlp.solution import sum_durations
from timelaw.problem.objective import Goal, TotalTime
from timelaw.reproduce.command import run_main
from timelaw.requirements.given_times import Budget

NODES = (30, 100, 300)
DEGREES = (7, 9, 13, 21)
FACTOR = 1.3
LIMITS = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}


def measure(legs: int, degree: int) -> tuple[float, float]:
    """Seconds for the least times of all legs, each another, and for the coupled program."""
    rows = drop_implied(list_rows(make_limits(LIMITS), np.array([0.0, 0.0, 1.0])))
    family = PolynomialFamily(degree, 2)
    runs = [RunProblem((Demand(float(a), rows),), family) for a in np.linspace(0.3, 2.0, legs)]
    start = time.perf_counter()
    least = solve_runs(runs).timings
    middle = time.perf_counter()
    given = FACTOR * sum_durations(least)
    goal = Goal(minimise="jerk", total_time=TotalTime(given))
    solve_together(runs, least, goal, [Deadline(Budget(legs, given), "", "the end", 0.0)])
    return middle - start, time.perf_counter() - middle


def main(arguments: Sequence[str]) -> None:
    """Print the table; an argument leaves out the sizes above it."""
    largest = int(arguments[0]) if arguments else NODES[-1]
    sizes = [n for n in NODES if n <= largest]
    print("| degree | " + " | ".join(f"{n} nodes: legs | together" for n in sizes) + " |")
    print("|---:" * (1 + 2 * len(sizes)) + "|")
    for degree in DEGREES:
        cells = [f"{seconds:.1f} s" for n in sizes for seconds in measure(n - 1, degree)]
        print(f"| {degree} | " + " | ".join(cells) + " |")
    print(f"\nMeasured on {os.cpu_count()} cores ({platform.machine()}), Python {platform.python_version()}.")


if __name__ == "__main__":
    run_main(main)
