"""The angle files of texture tools: .ang (EDAX/TSL) and .ctf (Oxford), Bunge's Euler angles.

Bunge's φ1, Φ, φ2 turn the specimen's axes into the crystal's about z, x', z'': with the crystal as
the body and the specimen as the world, R = Rz(φ1) Rx(Φ) Rz(φ2), intrinsic ZXZ. (As a passive
matrix, specimen to crystal, texture books print its transpose.) Points that were not indexed carry
no orientation and are left out; the others keep the number of their row as their label.
"""

from collections.abc import Callable, Iterator
from io import StringIO
from math import pi
from pathlib import Path

from timelaw.numerics.array import Array
from timelaw.orientations.forms import Writing, find_fault, make_quaternions
from timelaw.orientations.rows import EMPTY_ROW, make_fault, read_lines, read_number

Point = tuple[int, list[float], bool]  # line, three angles, whether the point was indexed

ANG_CONFIDENCE = 6  # column of the confidence index, counted from 0; -1 where nothing was indexed
CTF_COLUMNS = ("phase", "euler1", "euler2", "euler3")
NO_ANGLES = {"rad": 4 * pi, "deg": 720.0}  # all three angles are that in a point that was not indexed
TYPED = 1e-4  # relative: 12.566 is 4π too
MOST_RADIANS = 4 * pi + 1e-3  # two turns, as typed; larger numbers are degrees, where nobody says otherwise


def read_angles(path: Path, unit: str | None = None) -> tuple[Array, tuple[str, ...], int]:
    """Unit quaternions (N, 4), crystal to specimen, their labels, and how many points were left out.

    A label is the number of the point among the file's points, those that were not indexed included.
    `unit` is that of the file's kind unless given.

    Raises:
        InputError: with file, line and what is needed.
    """
    points, usual = READERS[path.suffix.lower()]
    writing = Writing("euler", "ZXZ", unit or usual)
    kept, labels, found = [], [], 0
    for line, angles, indexed in points(path):
        found += 1
        if not indexed or all(abs(a / NO_ANGLES[writing.unit] - 1) <= TYPED for a in angles):
            continue
        wrong = find_fault(angles, writing)
        if unit is None and usual == "rad" and max(map(abs, angles)) > MOST_RADIANS:
            wrong = f"{max(angles, key=abs):g} rad is more than two turns; in degrees? unit: deg"
        if wrong:
            raise make_fault(wrong, path, line)
        kept.append(angles)
        labels.append(str(found))
    if len(kept) < 2:
        raise make_fault(f"{len(kept)} indexed points; at least two are needed", path)
    return make_quaternions(kept, writing), tuple(labels), found - len(kept)


def _ang(path: Path) -> Iterator[Point]:
    """φ1 Φ φ2 [rad] x y IQ CI …, comments start with #."""
    lines = [(line, text) for line, text in _lines(path) if not text.lstrip().startswith("#")]
    for line, cells in _rows(lines, path):
        if len(cells) < 3:
            raise make_fault(f"{len(cells)} values; phi1, Phi, phi2 are needed", path, line)
        confidence = read_number(cells[ANG_CONFIDENCE], path, line) if len(cells) > ANG_CONFIDENCE else 0.0
        yield line, [read_number(cell, path, line) for cell in cells[:3]], confidence >= 0


def _ctf(path: Path) -> Iterator[Point]:
    """A header, then a table with the columns Phase, Euler1, Euler2, Euler3 [deg] among others."""
    lines = _lines(path)
    header = next((i for i, (_, text) in enumerate(lines) if set(CTF_COLUMNS) <= set(_names(text))), None)
    if header is None:
        raise make_fault("no line names the columns Phase, Euler1, Euler2, Euler3", path)
    names = _names(lines[header][1])
    phase, *angles = (names.index(c) for c in CTF_COLUMNS)
    for line, cells in _rows(lines[header + 1 :], path):
        if len(cells) != len(names):
            raise make_fault(f"{len(cells)} values; {len(names)} are needed", path, line)
        yield (
            line,
            [read_number(cells[i], path, line) for i in angles],
            read_number(cells[phase], path, line) != 0,
        )


def _lines(path: Path) -> list[tuple[int, str]]:
    """All lines with their numbers."""
    return list(enumerate(StringIO(read_lines(path), newline=None).read().split("\n"), 1))


def _names(text: str) -> list[str]:
    return [cell.strip().lower() for cell in text.rstrip().split("\t")]


def _rows(lines: list[tuple[int, str]], path: Path) -> Iterator[tuple[int, list[str]]]:
    """Rows of cells, each with as many as the first, none of them empty: they are numbered."""
    blank, width = 0, 0
    for line, text in lines:
        cells = text.rstrip().split("\t") if "\t" in text.strip() else text.split()
        if not cells:
            blank = blank or (line if text and width else 0)
            continue
        if blank:
            raise make_fault(EMPTY_ROW, path, blank)
        width = width or len(cells)
        if len(cells) != width:
            raise make_fault(f"{len(cells)} values; {width} are needed", path, line)
        yield line, cells


READERS: dict[str, tuple[Callable[[Path], Iterator[Point]], str]] = {
    ".ang": (_ang, "rad"),
    ".ctf": (_ctf, "deg"),
}
