"""The angle files of texture tools: .ang (EDAX/TSL) and .ctf (Oxford), Bunge's Euler angles.

Bunge's φ1, Φ, φ2 turn the specimen's axes into the crystal's about z, x', z'': with the crystal as
the body and the specimen as the world, R = Rz(φ1) Rx(Φ) Rz(φ2), intrinsic ZXZ. (As a passive
matrix, specimen to crystal, texture books print its transpose.) Points that were not indexed carry
no orientation and are left out.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

from timelaw.files import read_text
from timelaw.numerics.array import Array
from timelaw.orientations.forms import Writing, make_quaternions
from timelaw.orientations.table import make_fault, read_number

Point = tuple[int, list[float], bool]  # line, three angles, whether the point was indexed

ANG_CONFIDENCE = 6  # column of the confidence index, counted from 0; -1 where nothing was indexed
CTF_COLUMNS = ("phase", "euler1", "euler2", "euler3")


def read_angles(path: Path) -> tuple[Array, int]:
    """Unit quaternions (N, 4), crystal to specimen, and how many points were left out as not indexed.

    Raises:
        InputError: with file, line and what is needed.
    """
    points, unit = READERS[path.suffix.lower()]
    found = list(points(path))
    kept = [angles for _, angles, indexed in found if indexed]
    if len(kept) < 2:
        raise make_fault(f"{len(kept)} indexed points; at least two are needed", path)
    return make_quaternions(kept, Writing("euler", "ZXZ", unit)), len(found) - len(kept)


def _ang(path: Path) -> Iterator[Point]:
    """φ1 Φ φ2 [rad] x y IQ CI …, comments start with #."""
    for line, text in enumerate(read_text(path).splitlines(), 1):
        cells = text.split()
        if not cells or cells[0].startswith("#"):
            continue
        if len(cells) < 3:
            raise make_fault(f"{len(cells)} values; phi1, Phi, phi2 are needed", path, line)
        confidence = read_number(cells[ANG_CONFIDENCE], path, line) if len(cells) > ANG_CONFIDENCE else 0.0
        yield line, [read_number(cell, path, line) for cell in cells[:3]], confidence >= 0


def _ctf(path: Path) -> Iterator[Point]:
    """A header, then a table with the columns Phase, Euler1, Euler2, Euler3 [deg] among others."""
    lines = read_text(path).splitlines()
    names = [[cell.strip().lower() for cell in text.split("\t")] for text in lines]
    start = next((i for i, row in enumerate(names) if all(c in row for c in CTF_COLUMNS)), None)
    if start is None:
        raise make_fault("no line names the columns Phase, Euler1, Euler2, Euler3", path)
    phase, *angles = (names[start].index(c) for c in CTF_COLUMNS)
    for line, text in enumerate(lines[start + 1 :], start + 2):
        cells = text.split("\t") if "\t" in text else text.split()
        if not text.strip():
            continue
        if len(cells) <= max(phase, *angles):
            raise make_fault(f"{len(cells)} values; {max(phase, *angles) + 1} are needed", path, line)
        yield (
            line,
            [read_number(cells[i], path, line) for i in angles],
            read_number(cells[phase], path, line) != 0,
        )


READERS: dict[str, tuple[Callable[[Path], Iterator[Point]], str]] = {
    ".ang": (_ang, "rad"),
    ".ctf": (_ctf, "deg"),
}
