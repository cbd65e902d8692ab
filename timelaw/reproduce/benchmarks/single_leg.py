"""The part `leg`: the fastest law of a leg, alone and among many, beside Ruckig and Drake."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from timelaw.easing.family import DoubleSFamily, Family, PolynomialFamily, SplineFamily
from timelaw.nlp.single_runs import solve_runs
from timelaw.reproduce.benchmarks.machine import find_version
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.peers import drake_peer, ruckig_peer
from timelaw.reproduce.benchmarks.problems import LIMITS, draw_runs
from timelaw.reproduce.benchmarks.stopwatch import time_call
from timelaw.reproduce.benchmarks.table import MISSING, Table, format_ratio, format_spread

HEADINGS = (
    "law",
    "alone [ms]",
    "among the others [ms]",
    "above the double-S, mean",
    "alone, to Drake 3 × 27",
)
FAMILIES: dict[str, Family] = {
    "degree 9": PolynomialFamily(9, 2),
    "degree 13": PolynomialFamily(13, 2),
    "spline 4 × 50": SplineFamily(4, 50, 2),
    "double-S": DoubleSFamily(2),
}
COUNT = {True: 8, False: 100}  # legs, by quick
REPEATS = {True: 1, False: 3}
REFERENCE = "Drake 3 × 27"
NOTES = (
    "CPU for each leg, median (least–most): of single legs by themselves, each another; of all of them in "
    "one call, repeated. Drake's are B-splines by the solver that it chooses, of 27 pieces of degree 3 "
    "and 50 of degree 4; Ruckig's law is the double-S.",
)
Call = Callable[[float], Any]


def measure(*, quick: bool) -> Table:
    """Legs of random angles, each another, by every family, and by the peers that are there."""
    count, repeats = COUNT[quick], REPEATS[quick]
    w, a, j = (float(np.radians(value)) for value in LIMITS.values())
    peers: dict[str, tuple[str, Call]] = {
        REFERENCE: ("drake", partial(drake_peer.solve_angle, (w, a, j), 3, 30)),
        "Drake 4 × 50": ("drake", partial(drake_peer.solve_angle, (w, a, j), 4, 54)),
        "Ruckig": ("ruckig", partial(ruckig_peer.solve_angle, (w, a, j))),
    }
    runs = draw_runs(count, FAMILIES["double-S"])
    least = [run.run.limit for run in runs]
    alone: dict[str, list[float]] = {}
    rows: dict[str, list[str]] = {}
    for name, (package, solve) in peers.items():
        if find_version(package) is None:
            rows[name] = [MISSING, "", ""]
            continue
        angles = [run.demands[0].angle for run in runs]
        durations = [solve(angle).duration for angle in angles]
        alone[name] = [time_call(partial(solve, angle), 1)[0] for angle in angles]
        rows[name] = [format_spread(alone[name], 1e-3), "", _tell_excess(durations, least)]
    for name, family in FAMILIES.items():
        alone[name], *rows[name] = _measure_family(count, family, repeats, least)
    cells = (
        (name, *row, format_ratio(alone[name], alone[REFERENCE]) if {name, REFERENCE} <= alone.keys() else "")
        for name, row in sorted(rows.items(), key=lambda item: item[0] in peers)
    )
    return Table(HEADINGS, tuple(cells), NOTES)


def _measure_family(count: int, family: Family, repeats: int, least: list[float]) -> Iterator[Any]:
    """CPU of each leg alone [s], then the cells of its row."""
    runs = draw_runs(count, family)
    alone = [time_call(partial(solve_runs, [run]), 1)[0] for run in runs]
    durations = [timing.duration for timing in solve_runs(runs).timings]
    yield alone
    yield format_spread(alone, 1e-3)
    yield format_spread(time_call(partial(solve_runs, runs), repeats), 1e-3 * count)
    yield _tell_excess(durations, least)


def _tell_excess(durations: list[float], least: list[float]) -> str:
    return f"{100 * float(np.mean(np.divide(durations, least) - 1)):.3f} %"


PART = Part("leg", HEADINGS, measure)
