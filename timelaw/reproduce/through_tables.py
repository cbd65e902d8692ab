"""The tables of motions through the nodes: `python -m timelaw.reproduce.through_tables PAGE [--sets N]`.

Designed anew: the lattices under three sets of limits with one piece a leg and with two, bounds on leaving
the arcs, what the order of a tour is worth, N random sets, and one of a thousand orientations. The tables
between their marks are replaced.
"""

import json
import sys
import time
from argparse import ArgumentParser
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

from timelaw.errors import TimelawError
from timelaw.pipeline import Design, design_problem
from timelaw.problem.load import check_problem
from timelaw.problem.source import read
from timelaw.reproduce.command import run_main
from timelaw.reproduce.random_sets import KINDS, draw_large, draw_problem
from timelaw.reproduce.reference_tables import format_markdown, replace_table
from timelaw.time_law.baselines import time_double_s

LIMITS = {
    "60, 120, 600": (60, 120, 600),
    "1, 0.05, 0.01": (1, 0.05, 0.01),
    "720, 2000, 100000": (720, 2000, 100000),
}
ROUTES = {
    "24-cell, paper": ("24-cell", "paper"),
    "600-cell, shortest": ("600-cell", "shortest"),
    "120-cell, shortest": ("120-cell", "shortest"),
}
PIECES = {"24-cell": (1, 2, 3), "600-cell": (1, 2), "120-cell": (1, 2)}
DEVIATIONS = (None, 10, 5, 2, 1)  # deg
ORDERS = {
    "24-cell": ("paper", "shortest", "least-turning", "fewest-stops"),
    "600-cell": ("shortest", "least-turning", "fewest-stops"),
}


def make_problem(lattice: str, tour: str, limits: Sequence[float], motion: dict[str, Any]) -> dict[str, Any]:
    """The data of a problem file."""
    v, a, j = limits
    return {
        "timelaw": 1,
        "name": "table",
        "route": {"orientations": {"lattice": lattice}, "tour": tour},
        "motion": {"kind": "through", **motion},
        "limits": {"velocity": f"{v} deg/s", "acceleration": f"{a} deg/s^2", "jerk": f"{j} deg/s^3"},
        "baselines": [],
    }


def design_data(data: dict[str, Any]) -> tuple[Design, float]:
    """The design of a problem's data, and the CPU time [s] it took."""
    source = read(json.dumps(data), "<table>")
    begun = time.process_time()
    return design_problem(Path("table.yaml"), check_problem(source), source), time.process_time() - begun


def relate(design: Design, *, stop: bool = True) -> float:
    """Its time over that of the double-S, that stops at every node or at corners only."""
    beside = time_double_s(design.route, design.requirements, stop=stop)
    return design.optimised.law.duration / beside.duration


def tell(design: Design) -> str:
    """Whether it is proved, and passes the nodes."""
    proved = "certified" if design.optimised.certificate.holds else "NOT certified"
    return proved if design.through is not None and design.through.passed else f"{proved}, stops"


def list_lattices() -> Iterator[list[str]]:
    """One row for each route, set of limits and number of pieces."""
    for name, (lattice, tour) in ROUTES.items():
        for text, limits in LIMITS.items():
            for pieces in PIECES[lattice]:
                design, spent = design_data(make_problem(lattice, tour, limits, {"pieces": pieces}))
                duration = design.optimised.law.duration
                ratios = [f"{relate(design, stop=stop):.4f}" for stop in (True, False)]
                yield [name, text, str(pieces), f"{duration:.6g}", *ratios, f"{spent:.1f}", tell(design)]


def list_deviations() -> Iterator[list[str]]:
    """The paper's tour under bounds on leaving the arcs."""
    limits = LIMITS["60, 120, 600"]
    for bound in DEVIATIONS:
        motion = {} if bound is None else {"deviation": f"{bound} deg"}
        design, spent = design_data(make_problem("24-cell", "paper", limits, motion))
        asked = "free" if bound is None else f"{bound}°"
        duration = design.optimised.law.duration
        yield [asked, f"{duration:.4f}", f"{relate(design):.4f}", f"{spent:.1f}", tell(design)]


def list_orders() -> Iterator[list[str]]:
    """What the order of a tour is worth: stopping, and not."""
    for lattice, tours in ORDERS.items():
        for tour in tours:
            design, _ = design_data(make_problem(lattice, tour, LIMITS["60, 120, 600"], {}))
            route = design.route, design.requirements
            double_s = [time_double_s(*route, stop=stop).duration for stop in (True, False)]
            turning = np.degrees(sum(node.turn for node in design.route.nodes[1:-1]))
            times = [f"{value:.2f}" for value in (*double_s, design.optimised.law.duration)]
            yield [lattice, tour, f"{turning:.0f}°", *times]


def list_sets(count: int, seed: int, processes: int) -> Iterator[list[str]]:
    """One row for each kind of random set."""
    sets = [draw_problem(seed, number) for number in range(count)]
    found: dict[str, list[tuple[str, float, float]]] = {kind: [] for kind in KINDS}
    with ProcessPoolExecutor(processes) as pool:
        tried = pool.map(_try_set, [data for _, data in sets])
        for number, ((kind, _), result) in enumerate(zip(sets, tried, strict=True), 1):
            found[kind].append(result)
            print(f"set {number} of {count}: {kind}, {result[0]}", file=sys.stderr)
    for kind, results in found.items():
        if results:
            yield _summarise(kind, results)


def list_large_set(seed: int) -> Iterator[list[str]]:
    """The row of one set of a thousand."""
    yield _summarise("1000 nodes, nearest order", [_try_set(draw_large(seed))])


def _try_set(data: dict[str, Any]) -> tuple[str, float, float]:
    """What came of it, its ratio to the double-S at corners, the CPU time [s]."""
    try:
        design, spent = design_data(data)
    except TimelawError as error:
        return f"failed: {error}", float("nan"), 0.0
    return tell(design), relate(design, stop=False), spent


def _summarise(kind: str, results: Sequence[tuple[str, float, float]]) -> list[str]:
    told, ratios, spent = zip(*results, strict=True)
    return [
        kind,
        str(len(results)),
        str(sum(word.startswith("certified") for word in told)),
        str(told.count("certified")),
        f"{np.median(ratios):.3f}",
        f"{np.min(ratios):.3f} to {np.max(ratios):.3f}",
        f"{np.median(spent):.1f}, {np.max(spent):.1f}",
    ]


def main(arguments: Sequence[str]) -> None:
    """Design everything and rewrite the tables."""
    parser = ArgumentParser(description="make the tables of motions through the nodes again")
    parser.add_argument("page", type=Path)
    parser.add_argument("--sets", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--only", choices=[*TABLES, "sets", "large"])
    given = parser.parse_args(arguments)
    for mark, (headings, list_rows) in TABLES.items():
        if given.only in (None, mark):
            _replace(given.page, mark, format_markdown(headings, list(list_rows())))
    if given.only in (None, "sets"):
        _replace(
            given.page,
            "sets",
            format_markdown(SETS, list(list_sets(given.sets, given.seed, given.processes))),
        )
    if given.only in (None, "large"):
        _replace(given.page, "large", format_markdown(SETS, list(list_large_set(given.seed))))


def _replace(page: Path, mark: str, table: str) -> None:
    page.write_text(replace_table(page.read_text(encoding="utf-8"), table, mark), encoding="utf-8")


SETS = ("kind", "sets", "certified", "through", "median", "to double-S", "CPU, median and most [s]")
TABLES = {
    "lattices": (
        ("route", "limits", "pieces", "time [s]", "to every stop", "to corners", "CPU [s]", ""),
        list_lattices,
    ),
    "deviations": (("bound", "time [s]", "to every stop", "CPU [s]", ""), list_deviations),
    "orders": (
        ("lattice", "tour", "axis turns", "every stop [s]", "corners [s]", "through [s]"),
        list_orders,
    ),
}

if __name__ == "__main__":
    run_main(main)
