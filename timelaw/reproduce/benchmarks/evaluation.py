"""The part `evaluation`: q and ω at many times, beside SciPy's rotations and a copy of the bytes."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation, RotationSpline, Slerp

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.problems import LATTICES, POLYNOMIAL, SEED, design_data, make_lattice_data
from timelaw.reproduce.benchmarks.stopwatch import time_call
from timelaw.reproduce.benchmarks.table import Table, format_ratio, format_spread

HEADINGS = (
    "law",
    "times",
    "q and ω [ns]",
    "q, ω, α, jerk [ns]",
    "Slerp: q [ns]",
    "RotationSpline: q and ω [ns]",
    "copy of the bytes [ns]",
    "q and ω, million a second",
    "to RotationSpline",
    "to the copy",
)
TIMES = {True: 100_000, False: 1_000_000}  # by quick
REPEATS = {True: 3, False: 5}
NANOSECOND = 1e-9
NOTES = (
    "CPU for each time, median (least–most), in one process. SciPy's curves go through the same nodes at "
    "the same instants.",
)


def measure(*, quick: bool) -> Table:
    """Laws of degree 9 on the lattices, at sorted and at random times."""
    count, repeats = TIMES[quick], REPEATS[quick]
    rows: list[tuple[str, ...]] = []
    for name, data in list_laws():
        law = design_data(data).optimised.law
        t = np.random.default_rng(SEED).uniform(0.0, law.duration, count)
        rows += [
            (name, order, *_list_cells(law, times, repeats))
            for order, times in (("sorted", np.sort(t)), ("random", t))
        ]
    return Table(HEADINGS, tuple(rows), NOTES)


def list_laws() -> Iterator[tuple[str, dict[str, Any]]]:
    """Arcs on the lattices, and one of rational segments."""
    for legs in LATTICES:
        yield f"{legs} legs", make_lattice_data(legs, easing=POLYNOMIAL)
    yield "11 legs, through", make_lattice_data(11, motion={"kind": "through", "pieces": 1})


def evaluate_law(law: QuaternionLaw, t: Array, orders: Sequence[int]) -> Sequence[Array]:
    """What the law is at times, for all orders."""
    return law.evaluate(t, orders)


def _list_cells(law: QuaternionLaw, t: Array, repeats: int) -> Iterator[str]:
    nodes = Rotation.from_quat(law(law.times), scalar_first=True)
    slerp, spline = Slerp(law.times, nodes), RotationSpline(law.times, nodes)
    values = np.concatenate(evaluate_law(law, t, (0, 1)), axis=1)
    blank = np.empty_like(values)
    unit = NANOSECOND * len(t)
    both = time_call(lambda: evaluate_law(law, t, (0, 1)), repeats)
    beside = time_call(lambda: (spline(t).as_quat(), spline(t, 1)), repeats)
    copied = time_call(lambda: np.copyto(blank, values), repeats)
    yield format_spread(both, unit)
    yield format_spread(time_call(lambda: evaluate_law(law, t, range(4)), repeats), unit)
    yield format_spread(time_call(lambda: slerp(t).as_quat(), repeats), unit)
    yield format_spread(beside, unit)
    yield format_spread(copied, unit)
    yield f"{len(t) / float(np.median(both)) / 1e6:.1f}"
    yield format_ratio(both, beside)
    yield format_ratio(both, copied)


PART = Part("evaluation", HEADINGS, measure)
