"""A law's segments as one table of doubles, bit for bit, in which equal runs of pieces stand once.

A segment's record is its start time, its duration and what its kind has besides; the pieces it refers to by
where they begin: how many, two counts of rows, then of each piece its duration and the rows. Where pieces
differ in their counts these are zero, and each has its own after its duration.
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
    pieces = [(p["duration"], p["state"], p["bernstein"]) for p in document["pieces"]]
    track = table.append_once(_join_pieces(pieces, [(len(s), len(b)) for _, s, b in pieces]))
    return [*document["start"], *document["end"], *document["axis"], track]


def _list_dwell(document: dict[str, Any], table: Table) -> list[float]:  # noqa: ARG001
    return [*document["orientation"], *document.get("point", (0.0, 0.0, 0.0))]


def _list_rational(document: dict[str, Any], table: Table) -> list[float]:
    pieces, counts = [], []
    for p in document["pieces"]:
        control, points = _level(np.array(p["control"]), np.array(p.get("points", [])).reshape(-1, 3))
        pieces.append((p["duration"], control.ravel().tolist(), points.ravel().tolist()))
        counts.append((len(control), len(points)))
    return [*document["start"], *document["end"], table.append_once(_join_pieces(pieces, counts))]


def _join_pieces(
    pieces: Sequence[tuple[float, list[float], list[float]]], counts: Sequence[tuple[int, int]]
) -> list[float]:
    """Durations and rows of all pieces, and their counts, once if they are alike."""
    alike = len(set(counts)) == 1
    numbers: list[float] = [len(pieces), *(counts[0] if alike else (0, 0))]
    for (duration, rows, others), own in zip(pieces, counts, strict=True):
        numbers += [duration, *(() if alike else own), *rows, *others]
    return numbers


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
