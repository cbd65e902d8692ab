"""Orientation tables: CSV with a header that names the quaternion's columns."""

import csv
import io
import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from timelaw.errors import Fault, InputError
from timelaw.problem.load import read_text
from timelaw.problem.values import NORM_TOLERANCE

COLUMNS = (("w", "x", "y", "z"), ("qw", "qx", "qy", "qz"))
LABEL = "label"
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?")

Row = tuple[int, list[str]]


def read_table(path: Path) -> tuple[NDArray[np.float64], tuple[str, ...] | None]:
    """Unit quaternions (N, 4) and labels, if there is a column `label`, of a CSV file.

    Columns are found by the names w, x, y, z or qw, qx, qy, qz in any order, others are left
    alone. Lines before the header that start with # are comments.

    Raises:
        InputError: with file, line and what is needed.
    """
    rows = _rows(path)
    if not rows:
        raise _fault("no rows; a header w,x,y,z and a row per orientation are needed", path)
    header = [name.strip().lower() for name in rows[0][1]]
    wanted = next((c for c in COLUMNS if all(name in header for name in c)), None)
    if wanted is None:
        found = ", ".join(header)
        message = f"the header has {found}; columns w, x, y, z (or qw, qx, qy, qz) are needed"
        raise _fault(message, path, rows[0][0])
    repeated = next((name for name in header if name and header.count(name) > 1), None)
    if repeated is not None:
        raise _fault(f'the header names "{repeated}" more than once', path, rows[0][0])
    places = [header.index(name) for name in wanted]
    quaternions = [_quaternion(row, places, path, line) for line, row in rows[1:]]
    if len(quaternions) < 2:
        raise _fault(f"{len(quaternions)} orientations; at least two are needed", path)
    return np.array(quaternions), _labels(header, rows[1:], path)


def _rows(path: Path) -> list[Row]:
    """Non-empty rows with the number of the line on which each ends."""
    lines = read_text(path).splitlines(keepends=True)
    comments = 0
    while comments < len(lines) and (not lines[comments].strip() or lines[comments].lstrip().startswith("#")):
        comments += 1
    reader = csv.reader(
        io.StringIO("".join(lines[comments:]), newline=""), skipinitialspace=True, strict=True
    )
    rows: list[Row] = []
    try:
        rows.extend((comments + reader.line_num, row) for row in reader if any(cell.strip() for cell in row))
    except csv.Error as error:
        raise _fault(f"not readable as CSV: {error}", path, comments + reader.line_num) from None
    return rows


def _quaternion(row: list[str], places: list[int], path: Path, line: int) -> NDArray[np.float64]:
    if len(row) <= max(places):
        raise _fault(f"{len(row)} values; {max(places) + 1} are needed", path, line)
    cells = [row[i].strip() for i in places]
    wrong = next((cell for cell in cells if not NUMBER.fullmatch(cell)), None)
    if wrong is not None:
        raise _fault(f'"{wrong}" is not a number', path, line)
    q = np.array([float(cell) for cell in cells])
    norm = float(np.linalg.norm(q))
    if not abs(norm - 1) <= NORM_TOLERANCE:
        raise _fault(f"the quaternion has norm {norm:.6g}; a unit quaternion is needed", path, line)
    return q / norm


def _labels(header: list[str], rows: list[Row], path: Path) -> tuple[str, ...] | None:
    if LABEL not in header:
        return None
    place = header.index(LABEL)
    seen: dict[str, int] = {}
    for line, row in rows:
        label = row[place].strip() if place < len(row) else ""
        if not label or label in seen:
            raise _fault(
                f'label "{label}" stands in line {seen[label]} too' if label else "no label", path, line
            )
        seen[label] = line
    return tuple(seen)


def _fault(message: str, path: Path, line: int | None = None) -> InputError:
    return InputError(Fault(message, "", str(path), line, 1 if line is not None else None))
