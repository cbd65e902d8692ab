"""The parts `routes` and `easings`: designs against the number of legs, and against the easing."""

import json
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from timelaw.errors import TimelawError
from timelaw.nlp import optimise
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.problems import (
    POLYNOMIAL,
    draw_nodes,
    lay_out_data,
    list_route,
    make_data,
    take_first,
    tell_failure,
)
from timelaw.reproduce.benchmarks.stopwatch import read_memory, run_python, time_call
from timelaw.reproduce.benchmarks.table import Table, format_number, format_ratio, format_spread
from timelaw.requirements.route_limit import find_route_limit

HEADINGS = (
    "legs",
    "CPU [s]",
    "a leg [ms]",
    "ten times the legs",
    "memory [MB]",
    "whole command, CPU [s]",
    "whole, a leg [ms]",
    "whole, ten times",
    "whole, memory [MB]",
)
SIZES = (10, 100, 1000, 10_000)
OFTEN = 100  # legs; up to there it is measured more than once
NOTES = (
    "Random orientations in the order as they are drawn, degree 9. The first columns: the least times "
    "from the route on; then `timelaw design` as a command, quintic as the only baseline, with proofs, "
    "samples, report and start-up. Memory is the most that the process held.",
)
EASINGS = {
    "degree 7": {"basis": "polynomial", "degree": 7},
    "degree 9": POLYNOMIAL,
    "degree 13": {"basis": "polynomial", "degree": 13},
    "degree 21": {"basis": "polynomial", "degree": 21},
    "spline 3 × 50": {"basis": "spline", "degree": 3, "intervals": 50},
    "spline 4 × 50": {"basis": "spline", "degree": 4, "intervals": 50},
    "auto": {"basis": "auto"},
    "double-S": {"basis": "double-s"},
}
EASING_HEADINGS = ("easing", "a leg [ms]", "to degree 9", "to the physical limit")
EASING_LEGS = {True: 5, False: 100}  # by quick
REPEATS = {True: 1, False: 3}


def measure_routes(*, quick: bool) -> Table:
    """One row for each size: ten times the legs, and how many times what it took before."""
    rows = []
    before: tuple[float, float] | None = None
    for legs in take_first(quick, SIZES, 2):
        data = make_data(list_route(draw_nodes(legs + 1)), easing=POLYNOMIAL, baselines=["quintic"])
        layout = lay_out_data(data)
        call = partial(optimise, layout.problem, layout.route, layout.requirements)
        spent = time_call(call, 1 if quick or legs > OFTEN else 3)
        middle = sorted(spent)[len(spent) // 2]
        cells = [f"{legs}", format_spread(spent), format_number(1e3 * middle / legs)]
        cells += [format_number(middle / before[0]) if before else "", f"{read_memory():.0f}"]
        try:
            with TemporaryDirectory() as folder:
                Path(folder, "measured.yaml").write_text(json.dumps(data), encoding="utf-8")
                whole = run_python(["-m", "timelaw", "design", "measured.yaml"], Path(folder))
        except TimelawError as error:
            rows.append((*cells, *tell_failure(error, 4)))
            continue
        growth = format_number(whole.cpu / before[1]) if before else ""
        cells += [
            format_number(whole.cpu),
            format_number(1e3 * whole.cpu / legs),
            growth,
            f"{whole.memory:.0f}",
        ]
        rows.append(tuple(cells))
        before = middle, whole.cpu
    return Table(HEADINGS, tuple(rows), NOTES)


def measure_easings(*, quick: bool) -> Table:
    """One row for each easing, on one random route."""
    legs = EASING_LEGS[quick]
    route = list_route(draw_nodes(legs + 1))
    found = {}
    for name, easing in EASINGS.items():
        layout = lay_out_data(make_data(route, easing=easing))
        call = partial(optimise, layout.problem, layout.route, layout.requirements)
        least = find_route_limit(layout.route, layout.requirements)
        moving = sum(timing.duration for timing in call()[1].timings)
        found[name] = time_call(call, REPEATS[quick]), moving / least
    rows = (
        (name, format_spread(spent, 1e-3 * legs), format_ratio(spent, found["degree 9"][0]), f"{ratio:.4f}")
        for name, (spent, ratio) in found.items()
    )
    return Table(
        EASING_HEADINGS, tuple(rows), (f"{legs} random legs, each another; CPU, median (least–most).",)
    )


PARTS = (Part("routes", HEADINGS, measure_routes), Part("easings", EASING_HEADINGS, measure_easings))
