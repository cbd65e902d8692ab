"""The part `certificate`: proofs of laws of all kinds, beside sampling them."""

import time
from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from timelaw.certificate import certify
from timelaw.law_file.document import from_document, to_document
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.reproduce.benchmarks.evaluation import evaluate_law
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.problems import LATTICES, POLYNOMIAL, SPLINE, design_data, make_lattice_data
from timelaw.reproduce.benchmarks.stopwatch import time_call
from timelaw.reproduce.benchmarks.table import Table, format_number, format_ratio, format_spread

HEADINGS = ("legs", "law", "CPU [ms]", "a leg [ms]", "sampling [ms]", "to sampling")
KINDS: dict[str, dict[str, Any]] = {
    "degree 9": {"easing": POLYNOMIAL},
    "degree 4 × 50": {"easing": SPLINE},
    "double-S": {"easing": {"basis": "double-s"}},
    "rational, one sextic a leg": {"motion": {"kind": "through", "pieces": 1}},
}
INSTANTS = 1000  # a leg, at which sampling looks
REPEATS = {True: 3, False: 5}  # by quick
QUICK = (11, 59)  # legs
NOTES = (
    "Limits for all t, continuity, nodes: all that `timelaw verify` proves, without reading the file. "
    "Beside it the largest |ω|, |α|, |jerk| at 1000 instants a leg, which proves nothing. CPU, median "
    "(least–most).",
)


def measure(*, quick: bool) -> Table:
    """Every kind of law on the lattices."""
    legs = QUICK if quick else tuple(LATTICES)
    rows = [row for count in legs for row in _list_rows(count, REPEATS[quick])]
    return Table(HEADINGS, tuple(rows), NOTES)


def _list_rows(legs: int, repeats: int) -> Iterator[tuple[str, ...]]:
    for name, others in KINDS.items():
        law = design_data(make_lattice_data(legs, **others)).optimised.law
        t = np.linspace(0.0, law.duration, legs * INSTANTS)
        proofs = time_proofs(law, repeats)
        looks = time_call(partial(find_largest, law, t), repeats)
        yield (
            str(legs),
            name,
            format_spread(proofs, 1e-3),
            format_number(1e3 * float(np.median(proofs)) / legs),
            format_spread(looks, 1e-3),
            format_ratio(proofs, looks),
        )


def time_proofs(law: QuaternionLaw, repeats: int) -> list[float]:
    """CPU seconds of proofs, after one that is not counted, each of a law read anew."""
    document = to_document(law)
    spent = []
    for _ in range(repeats + 1):
        fresh = from_document(document, "measured")
        begun = time.process_time()
        certify(fresh)
        spent.append(time.process_time() - begun)
    return spent[1:]


def find_largest(law: QuaternionLaw, t: Array) -> list[float]:
    """The largest |ω|, |α|, |jerk| at times."""
    return [float(np.max(np.linalg.norm(rate, axis=1))) for rate in evaluate_law(law, t, (1, 2, 3))]


PART = Part("certificate", HEADINGS, measure)
