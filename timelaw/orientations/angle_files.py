"""The angle files of texture tools: .ang (EDAX/TSL, EMsoft, ASTAR) and .ctf (Oxford), Bunge's Euler angles.

Bunge's φ1, Φ, φ2 turn the specimen's axes into the crystal's about z, x', z'': with the crystal as
the body and the specimen as the world, R = Rz(φ1) Rx(Φ) Rz(φ2), intrinsic ZXZ. (As a passive
matrix, specimen to crystal, texture books print its transpose.) Points that were not indexed carry
no orientation and are left out, as are those of other phases than the one that is asked for; the rest keep
the number of their row as their label. Maps are read line by line.
"""

from array import array
from collections.abc import Callable, Iterator, Sequence
from math import pi
from operator import itemgetter
from pathlib import Path
from typing import NamedTuple

import numpy as np

from timelaw.files import stream_lines
from timelaw.numerics.array import Array
from timelaw.orientations.forms import Writing, convert
from timelaw.orientations.rows import EMPTY_ROW, NUMBER, make_fault, read_number
from timelaw.units import MOST

MAX_BYTES = 500_000_000
MOST_POINTS = 4_000_000  # that are kept, each with its label; a map of 200 MB has fewer
ANG_CONFIDENCE, ANG_PHASE = 6, 7  # columns counted from 0, of all makers; confidence -1: not indexed
CTF_COLUMNS = ("phase", "euler1", "euler2", "euler3")
NO_ANGLES = {"rad": 4 * pi, "deg": 720.0}  # all three angles are that in a point that was not indexed
MOST_NAMED = 20  # phases in a message
TYPED = 1e-4  # relative: 12.566 is 4π too
MOST_RADIANS = 4 * pi + 1e-3  # two turns, as typed; larger numbers are degrees, where nobody says otherwise


class Point(NamedTuple):
    """A row: its line, three angles as they are written, whether it was indexed, and its phase."""

    line: int
    angles: Sequence[str]
    indexed: bool
    phase: str


class AngleMap(NamedTuple):
    """Unit quaternions (N, 4), crystal to specimen, labels, and what was left out."""

    quaternions: Array
    labels: tuple[str, ...]
    unindexed: int
    other_phases: int


def read_angles(path: Path, unit: str | None = None, phase: int | None = None) -> AngleMap:
    """The orientations of a map, of one `phase` if that is given.

    A label is the number of the point among the file's points, those that are left out included.
    `unit` is that of the file's kind unless given.

    Raises:
        InputError: with file, line and what is needed.
    """
    points, usual = READERS[path.suffix.lower()]
    writing = Writing("euler", "ZXZ", unit or usual)
    kept, labels, found, others = array("d"), array("l"), 0, 0
    phases: dict[str, bool] = {}
    most = MOST_RADIANS if unit is None and usual == "rad" else MOST
    none = NO_ANGLES[writing.unit]
    near = TYPED * none
    for point in points(path):
        found += 1
        angles = _read_angles(point, path)
        if angles is None or (abs(angles[0] - none) <= near and max(abs(a - none) for a in angles) <= near):
            continue
        if phase is not None and not _is_phase(point, phase, phases, path):
            others += 1
            continue
        if max(map(abs, angles)) > most:
            wrong = f"{max(angles, key=abs):g} rad is more than two turns; in degrees? unit: deg"
            raise make_fault(wrong, path, point.line)
        if len(labels) == MOST_POINTS:
            raise make_fault(f"more than {MOST_POINTS} points; choose a phase", path, point.line)
        kept.extend(angles)
        labels.append(found)
    if len(labels) < 2:
        there = f"; the phases are {', '.join(sorted(phases))}" if phases else ""
        what = "indexed points" if phase is None else f"indexed points of phase {phase}"
        raise make_fault(f"{len(labels)} {what}; at least two are needed{there}", path)
    quaternions = convert(np.frombuffer(kept).reshape(-1, 3), writing)
    return AngleMap(quaternions, tuple(map(str, labels)), found - len(labels) - others, others)


def _read_angles(point: Point, path: Path) -> list[float] | None:
    """Three numbers; none of a point that was not indexed, whatever is written there."""
    if not point.indexed:
        return None
    try:
        angles = [float(cell) for cell in point.angles]
    except ValueError:
        angles = []
    if angles and sum(map(abs, angles)) <= MOST and "_" not in "".join(point.angles):
        return angles  # Python's reading is the quicker one, ours the stricter
    if all(cell.strip().lower() == "nan" for cell in point.angles):
        return None
    return [_read(cell, path, point.line) for cell in point.angles]


def _read(cell: str, path: Path, line: int) -> float:
    """A number, also where commas stand for points: no comma divides cells here."""
    plain = cell.replace(",", ".", 1)
    return read_number(plain if NUMBER.fullmatch(plain.strip()) else cell, path, line)


def _is_phase(point: Point, phase: int, phases: dict[str, bool], path: Path) -> bool:
    """Whether a point is of a phase; the answers are noted by what is written, but not without end."""
    known = phases.get(point.phase)
    if known is None:
        if not point.phase:
            raise make_fault("this file has no column of phases", path, point.line)
        known = _read(point.phase, path, point.line) == phase
        if len(phases) < MOST_NAMED:
            phases[point.phase] = known
    return known


def _ang(path: Path) -> Iterator[Point]:
    """φ1 Φ φ2 [rad] x y IQ CI phase …, comments start with #."""
    lines = ((n, text) for n, text in _lines(path) if not text.lstrip().startswith("#"))
    for line, cells in _rows(lines, path):
        if len(cells) < 3:
            raise make_fault(f"{len(cells)} values; phi1, Phi, phi2 are needed", path, line)
        confidence = cells[ANG_CONFIDENCE] if len(cells) > ANG_CONFIDENCE else "0"
        indexed = _read_confidence(confidence, path, line)
        yield Point(line, cells[:3], indexed, cells[ANG_PHASE] if len(cells) > ANG_PHASE else "")


def _read_confidence(cell: str, path: Path, line: int) -> bool:
    """Whether a confidence says that the point was indexed; one that is no number says that it was not."""
    return cell.lower() != "nan" and _read(cell, path, line) >= 0


def _ctf(path: Path) -> Iterator[Point]:
    """A header, then a table with the columns Phase, Euler1, Euler2, Euler3 [deg] among others."""
    lines = _lines(path)
    names = next((n for n in (_names(text) for _, text in lines) if set(CTF_COLUMNS) <= set(n)), None)
    if names is None:
        raise make_fault("no line names the columns Phase, Euler1, Euler2, Euler3", path)
    phase, *angles = (names.index(c) for c in CTF_COLUMNS)
    take = itemgetter(*angles)
    known = {"0": False}
    for line, cells in _rows(lines, path, len(names)):
        own = cells[phase]
        indexed = known.get(own)
        if indexed is None:
            indexed = _read(own, path, line) != 0
            if len(known) < MOST_NAMED:
                known[own] = indexed
        yield Point(line, take(cells), indexed, own)


def _lines(path: Path) -> Iterator[tuple[int, str]]:
    """All lines with their numbers."""
    return enumerate(stream_lines(path, MAX_BYTES), 1)


def _names(text: str) -> list[str]:
    return [cell.strip().lower() for cell in text.rstrip().split("\t")]


def _rows(lines: Iterator[tuple[int, str]], path: Path, width: int = 0) -> Iterator[tuple[int, list[str]]]:
    """Rows of `width` cells, or each with as many as the first, none of them empty: they are numbered."""
    blank, rows = 0, 0
    for line, text in lines:
        cells = text.rstrip().split("\t") if "\t" in text.strip() else text.split()
        if not cells:
            blank = blank or (line if text and rows else 0)
            continue
        if blank:
            raise make_fault(EMPTY_ROW, path, blank)
        width, rows = width or len(cells), rows + 1
        if len(cells) != width:
            raise make_fault(f"{len(cells)} values; {width} are needed", path, line)
        yield line, cells


READERS: dict[str, tuple[Callable[[Path], Iterator[Point]], str]] = {
    ".ang": (_ang, "rad"),
    ".ctf": (_ctf, "deg"),
}
