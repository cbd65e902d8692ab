"""STK's attitude files (.a) as orientations: quaternions, Euler angles, direction cosines.

They turn the reference axes into the body's: quaternions are those here, but for the order of components;
direction cosines are Rᵀ of the R here. Rates are left alone.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from timelaw.errors import shorten
from timelaw.files import stream_lines
from timelaw.numerics.array import Array
from timelaw.orientations.attitude_rows import normalise_rows, read_sequence
from timelaw.orientations.forms import Writing, convert, find_fault
from timelaw.orientations.rows import make_fault, read_number

MAX_BYTES = 50_000_000
MOST_ROWS = 500_000


class _Layout(NamedTuple):
    """What follows the time in a row: so many numbers, of a kind."""

    width: int
    kind: str


SCALAR_LAST, SCALAR_FIRST, ANGLES, COSINES = "xyzw", "wxyz", "euler", "matrix"
LAYOUTS = {
    "attitudetimequaternions": _Layout(4, SCALAR_LAST),
    "attitudetimequatangvels": _Layout(4, SCALAR_LAST),
    "attitudetimequatscalarfirst": _Layout(4, SCALAR_FIRST),
    "attitudetimeeulerangles": _Layout(3, ANGLES),
    "attitudetimeeuleranglesandrates": _Layout(3, ANGLES),
    "attitudetimedcm": _Layout(9, COSINES),
    "attitudetimedcmangvels": _Layout(9, COSINES),
}


def read_stk(path: Path) -> tuple[Array, tuple[str, ...]]:
    """Unit quaternions (N, 4), body to world, and notes.

    Raises:
        InputError: with file, line and what is needed.
    """
    layout: _Layout | None = None
    sequence = ("", 0)
    lines: list[int] = []
    rows: list[list[float]] = []
    for line, raw in enumerate(stream_lines(path, MAX_BYTES), 1):
        text = raw.split("#")[0].strip()
        word = text.split(maxsplit=1)[0].lower() if text else ""
        if line == 1 and not word.startswith("stk.v."):
            raise make_fault("not a file of STK: its first line is stk.v. and a version", path, line)
        if word == "end":
            break  # which may be missing
        if layout is not None and word:
            rows.append(_read_row(text.split(), layout, path, line))
            lines.append(line)
            if len(rows) > MOST_ROWS:
                raise make_fault(f"more than {MOST_ROWS} attitudes", path, line)
        elif word == "sequence":
            sequence = (text.split(maxsplit=1)[-1], line)
        elif word.startswith("attitudetime"):
            layout = _find_layout(text, path, line)
    if layout is None:
        raise make_fault(f"no block of attitudes; {', '.join(LAYOUTS)} are read", path)
    if len(rows) < 2:
        raise make_fault(f"{len(rows)} attitudes; at least two are needed", path)
    return _convert(np.array(rows), lines, layout, sequence, path)


def _find_layout(text: str, path: Path, line: int) -> _Layout:
    layout = LAYOUTS.get(text.split(maxsplit=1)[0].lower())
    if layout is None:
        raise make_fault(f'"{shorten(text)}"; {", ".join(LAYOUTS)} are read', path, line)
    return layout


def _read_row(cells: list[str], layout: _Layout, path: Path, line: int) -> list[float]:
    """A time, the attitude, and rates."""
    if len(cells) < 1 + layout.width:
        raise make_fault(f"{len(cells)} values; a time and {layout.width} numbers are needed", path, line)
    return [read_number(cell, path, line) for cell in cells[1 : 1 + layout.width]]


def _convert(
    rows: Array, lines: list[int], layout: _Layout, sequence: tuple[str, int], path: Path
) -> tuple[Array, tuple[str, ...]]:
    if layout.kind in (SCALAR_LAST, SCALAR_FIRST):
        return normalise_rows(rows if layout.kind == SCALAR_FIRST else np.roll(rows, 1, axis=1), lines, path)
    if layout.kind == ANGLES:
        if not sequence[0]:
            raise make_fault("Euler angles need a Sequence, such as 321", path)
        return convert(rows, Writing("euler", read_sequence(*_take(sequence, path)), "deg")), ()
    writing = Writing("matrix")
    turned = rows[:, [0, 3, 6, 1, 4, 7, 2, 5, 8]]
    for line, row in zip(lines, turned.tolist(), strict=True):
        wrong = find_fault(row, writing)
        if wrong:
            raise make_fault(wrong, path, line)
    return convert(turned, writing), ()


def _take(sequence: tuple[str, int], path: Path) -> tuple[str, Path, int]:
    return sequence[0], path, sequence[1]
