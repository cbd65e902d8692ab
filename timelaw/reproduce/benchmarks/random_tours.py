"""The part `tours`: short tours of random orientations, beside the nearest neighbour and fast_tsp."""

import json
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from timelaw.numerics.array import Array
from timelaw.orientations import read_orientations
from timelaw.problem.load import check_problem
from timelaw.problem.source import read
from timelaw.reproduce.benchmarks.machine import find_version
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.problems import draw_nodes, list_route, make_data, take_first
from timelaw.reproduce.benchmarks.stopwatch import read_memory
from timelaw.reproduce.benchmarks.table import MISSING, Table, format_number
from timelaw.tours import find_tour
from timelaw.tours.merit import LENGTH

HEADINGS = (
    "nodes",
    "CPU [s]",
    "memory [MB]",
    "above the bound",
    "nearest neighbour: length",
    "its CPU [s]",
    "fast_tsp: length",
    "its CPU [s]",
)
SIZES = (60, 300, 1000, 5000)
LARGEST = 65535  # of the whole numbers that fast_tsp takes
LEAST_TIME = 0.1  # s, for fast_tsp
PACKAGE = "fast-tsp"


def measure(*, quick: bool) -> Table:
    """One row for each size."""
    rows = tuple(_list_cells(count) for count in take_first(quick, SIZES, 2))
    notes = (
        "`tour: shortest`, closed, with its lower bound, which is part of the time. Lengths of the others "
        "are over that of timelaw's tour.",
        f"**fast_tsp** ({find_version(PACKAGE) or MISSING}): one thread, the same distances as the whole "
        "numbers to 65535 that it takes, and as much time as timelaw took, at least 0.1 s. It stops by "
        "the clock, so that its tour is not the same every time, and gives no bound.",
    )
    return Table(HEADINGS, rows, notes)


def _list_cells(count: int) -> tuple[str, ...]:
    nodes = draw_nodes(count)
    route = {**list_route(nodes), "tour": "shortest", "closed": True}
    problem = check_problem(read(json.dumps(make_data(route)), "<measured>"))
    assert problem.route.orientations is not None
    begun = time.process_time()
    found = find_tour(problem, read_orientations(problem.route.orientations, Path()))
    spent = time.process_time() - begun
    memory = read_memory()
    merit = next(merit for merit in found.merits if merit.name == LENGTH)
    own = measure_tour(nodes, found.order)
    begun = time.process_time()
    near = measure_tour(nodes, visit_nearest(nodes))
    nearest = time.process_time() - begun
    return (
        str(count),
        format_number(spent),
        f"{memory:.0f}",
        f"{100 * (own / merit.bound - 1):.2f} %",
        f"{near / own:.4f}",
        format_number(nearest),
        *_try_fast_tsp(nodes, max(spent, LEAST_TIME), own),
    )


def measure_tour(nodes: Array, order: Sequence[int]) -> float:
    """The angle [rad] that the body turns by on a closed tour."""
    visits = nodes[list(order)]
    cosines = np.abs(np.sum(visits * np.roll(visits, -1, axis=0), axis=1))
    return float(np.sum(2 * np.arccos(np.minimum(cosines, 1.0))))


def visit_nearest(nodes: Array) -> list[int]:
    """From the first node on always the nearest that is left."""
    order, left = [0], np.arange(1, len(nodes))
    while len(left):
        near = int(np.argmax(np.abs(nodes[left] @ nodes[order[-1]])))
        order.append(int(left[near]))
        left = np.delete(left, near)
    return order


def _try_fast_tsp(nodes: Array, seconds: float, own: float) -> tuple[str, str]:
    """Its length over ours, and its CPU [s]."""
    if find_version(PACKAGE) is None:
        return MISSING, ""
    import fast_tsp

    angles = 2 * np.arccos(np.minimum(np.abs(nodes @ nodes.T), 1.0))
    parts = np.rint(LARGEST / np.pi * angles).astype(int).tolist()
    begun = time.process_time()
    order = fast_tsp.find_tour(parts, duration_seconds=seconds)
    return f"{measure_tour(nodes, order) / own:.4f}", format_number(time.process_time() - begun)


PART = Part("tours", HEADINGS, measure)
