"""The part `coupled`: one program over all legs, least jerk in 1.3 times the least time."""

import time

from timelaw.easing.family import PolynomialFamily
from timelaw.nlp.all_runs import Deadline, solve_together
from timelaw.nlp.single_runs import solve_runs
from timelaw.nlp.solution import sum_durations
from timelaw.problem.objective import Goal, TotalTime
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.problems import draw_runs, take_first
from timelaw.reproduce.benchmarks.stopwatch import read_memory
from timelaw.reproduce.benchmarks.table import Table, format_number, format_ratio, format_spread
from timelaw.requirements.given_times import Budget

HEADINGS = ("legs", "degree", "CPU [s]", "a leg [ms]", "to the legs' least times", "memory [MB]")
SIZES = (100, 300, 1000)
DEGREES = (7, 9, 13, 21)
MAIN = 9  # of the sizes; the others are for a hundred legs
FACTOR = 1.3
REPEATS = {True: 1, False: 3}  # by quick
NOTES = (
    "Legs of random angles, each another and from stop to stop: one sparse program over all, from the "
    "least times, which are solved before it and stand beside it as a ratio. CPU, median (least–most).",
)


def measure(*, quick: bool) -> Table:
    """Sizes at one degree, then the other degrees at the least size."""
    cases = [(SIZES[0], degree) for degree in DEGREES if degree != MAIN]
    cases = [] if quick else cases
    cases += [(legs, MAIN) for legs in take_first(quick, SIZES, 1)]
    return Table(HEADINGS, tuple(_list_cells(legs, degree, REPEATS[quick]) for legs, degree in cases), NOTES)


def _list_cells(legs: int, degree: int, repeats: int) -> tuple[str, ...]:
    runs = draw_runs(legs, PolynomialFamily(degree, 2))
    begun = time.process_time()
    least = solve_runs(runs).timings
    apart = time.process_time() - begun
    given = FACTOR * sum_durations(least)
    goal = Goal(minimise="jerk", total_time=TotalTime(given))
    deadlines = [Deadline(Budget(legs, given), "", "the end", 0.0)]
    spent = []
    for _ in range(repeats):
        begun = time.process_time()
        solve_together(runs, least, goal, deadlines)
        spent.append(time.process_time() - begun)
    middle = sorted(spent)[len(spent) // 2]
    cells = str(legs), str(degree), format_spread(spent), format_number(1e3 * middle / legs)
    return (*cells, format_ratio(spent, [apart]), f"{read_memory():.0f}")


PART = Part("coupled", HEADINGS, measure)
