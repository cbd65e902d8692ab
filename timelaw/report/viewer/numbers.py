"""A law's segments as one table of doubles, bit for bit, in which equal runs of pieces stand once.

A segment's record is its start time, its duration and what its kind has besides; the pieces it refers to by
where they begin: how many, then of each its duration, two counts, and as many rows of numbers.
"""

import base64
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array

ALIKE = 13  # digits; legs whose pieces agree to so many are run through alike


class Table:
    """Numbers one after the other, and where runs of pieces stand."""

    def __init__(self) -> None:
        self.numbers: list[float] = []
        self._known: dict[str, int] = {}

    def append(self, numbers: Sequence[float]) -> int:
        """Where they begin."""
        offset = len(self.numbers)
        self.numbers.extend(numbers)
        return offset

    def append_once(self, numbers: Sequence[float]) -> int:
        """Where the like of them begin."""
        key = " ".join(f"{number:.{ALIKE - 1}e}" for number in numbers)
        if key not in self._known:
            self._known[key] = self.append(numbers)
        return self._known[key]

    def encode(self) -> str:
        """Little-endian doubles in base 64."""
        return base64.b64encode(np.array(self.numbers, dtype="<f8").tobytes()).decode("ascii")


def _list_arc(document: dict[str, Any], table: Table) -> list[float]:
    pieces = [float(len(document["pieces"]))]
    for p in document["pieces"]:
        pieces += [p["duration"], len(p["state"]), len(p["bernstein"]), *p["state"], *p["bernstein"]]
    return [*document["start"], *document["end"], *document["axis"], table.append_once(pieces)]


def _list_dwell(document: dict[str, Any], table: Table) -> list[float]:  # noqa: ARG001
    return [*document["orientation"], *document.get("point", (0.0, 0.0, 0.0))]


def _list_rational(document: dict[str, Any], table: Table) -> list[float]:
    pieces = [float(len(document["pieces"]))]
    for p in document["pieces"]:
        control, points = _level(np.array(p["control"]), np.array(p.get("points", [])).reshape(-1, 3))
        pieces += [p["duration"], len(control), len(points), *control.ravel().tolist()]
        pieces += points.ravel().tolist()
    return [*document["start"], *document["end"], table.append_once(pieces)]


def _level(control: Array, points: Array) -> tuple[Array, Array]:
    """Control points over a power of two, points over its square: the same motion, as large as one."""
    _, exponent = np.frexp(np.max(np.abs(control)))
    return np.ldexp(control, -exponent), np.ldexp(points, -2 * exponent)


RECORDS: dict[str, Callable[[dict[str, Any], Table], list[float]]] = {
    "arc": _list_arc,
    "dwell": _list_dwell,
    "rational": _list_rational,
}


def tabulate_segments(law: QuaternionLaw) -> tuple[str, list[list[int]]]:
    """The encoded table, and of each segment the number of its kind in `RECORDS` and its record's offset."""
    table, kinds, places = Table(), list(RECORDS), []
    for segment in law.segments:
        document = segment.document()
        record = RECORDS[segment.kind](document, table)
        offset = table.append([document["start_time"], document["duration"], *record])
        places.append([kinds.index(segment.kind), offset])
    return table.encode(), places
