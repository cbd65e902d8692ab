"""Orientation tables: CSV with a header that names the quaternion's columns."""

import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from timelaw.errors import Fault, InputError
from timelaw.problem.load import read_text
from timelaw.problem.values import NORM_TOLERANCE

COLUMNS = (("w", "x", "y", "z"), ("qw", "qx", "qy", "qz"))
LABEL = "label"


def read_table(path: Path) -> tuple[NDArray[np.float64], tuple[str, ...] | None]:
    """Unit quaternions (N, 4) and labels, if there is a column `label`, of a CSV file.

    Columns are found by the names w, x, y, z or qw, qx, qy, qz in any order, others are left
    alone; lines that start with # are comments.

    Raises:
        InputError: with file, line and what is needed.
    """
    rows = [
        (number, next(csv.reader([line], skipinitialspace=True)))
        for number, line in enumerate(read_text(path).splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not rows:
        raise InputError(
            Fault("no rows; a header w,x,y,z and a row per orientation are needed", "", str(path))
        )
    header = [name.strip().lower() for name in rows[0][1]]
    wanted = next((c for c in COLUMNS if all(name in header for name in c)), None)
    if wanted is None:
        found = ", ".join(header)
        message = f"the header has {found}; columns w, x, y, z (or qw, qx, qy, qz) are needed"
        raise InputError(Fault(message, "", str(path), rows[0][0], 1))
    places = [header.index(name) for name in wanted]
    quaternions = [_quaternion(row, places, path, line) for line, row in rows[1:]]
    if len(quaternions) < 2:
        raise InputError(Fault(f"{len(quaternions)} orientations; at least two are needed", "", str(path)))
    return np.array(quaternions), _labels(header, rows[1:], path)


def _quaternion(row: list[str], places: list[int], path: Path, line: int) -> NDArray[np.float64]:
    try:
        q = np.array([float(row[i]) for i in places])
    except IndexError:
        message = f"{len(row)} values; {max(places) + 1} are needed"
        raise InputError(Fault(message, "", str(path), line, 1)) from None
    except ValueError as error:
        raise InputError(Fault(f"{error}; numbers are needed", "", str(path), line, 1)) from None
    norm = float(np.linalg.norm(q))
    if not abs(norm - 1) <= NORM_TOLERANCE:
        message = f"the quaternion has norm {norm:.6g}; a unit quaternion is needed"
        raise InputError(Fault(message, "", str(path), line, 1))
    return q / norm


def _labels(header: list[str], rows: list[tuple[int, list[str]]], path: Path) -> tuple[str, ...] | None:
    if LABEL not in header:
        return None
    place = header.index(LABEL)
    seen: dict[str, int] = {}
    for line, row in rows:
        label = row[place].strip() if place < len(row) else ""
        if not label or label in seen:
            message = f'label "{label}" stands in line {seen[label]} too' if label else "no label"
            raise InputError(Fault(message, "", str(path), line, 1))
        seen[label] = line
    return tuple(seen)
