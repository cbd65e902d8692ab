"""Orientation tables: CSV with a header that names the columns, or plain numbers in a named form."""

import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path

from timelaw.errors import Fault, InputError
from timelaw.files import read_text
from timelaw.numerics.array import Array
from timelaw.orientations.forms import FORMS, Writing, find_fault, find_precision, make_quaternions
from timelaw.orientations.precision import Precision
from timelaw.units import MOST

LABEL = "label"
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?")
SEPARATORS = (",", ";", "\t", " ")

Row = tuple[int, list[str]]


def read_table(
    path: Path, writing: Writing | None = None, columns: Sequence[str] | None = None
) -> tuple[Array, tuple[str, ...] | None, Precision]:
    """Unit quaternions (N, 4), labels if there is a column `label`, and the precision of a text table.

    Columns are found by name in any order, those of the form (w, x, y, z or qw, qx, qy, qz for
    quaternions) or the `columns` given; others are left alone. Where a form is given, a table
    without a header is read from its first columns. Values are separated by commas, semicolons,
    tabs or blanks. Lines before the header that start with # are comments.

    Raises:
        InputError: with file, line and what is needed.
    """
    form = FORMS[writing.form if writing else "wxyz"]
    rows = _rows(path)
    if not rows:
        needed = ",".join(columns or form.columns[0])
        raise make_fault(f"no rows; a header {needed} and a row per orientation are needed", path)
    header = [name.strip().lower() for name in rows[0][1]]
    if writing and not columns and all(NUMBER.fullmatch(name) for name in header if name):
        places, labels = list(range(form.width)), None
    else:
        places = _places(header, columns, form.columns, path, rows[0][0])
        rows = rows[1:]
        labels = _labels(header, rows, path)
    table = [_numbers(row, places, path, line, writing or Writing()) for line, row in rows]
    if len(table) < 2:
        raise make_fault(f"{len(table)} orientations; at least two are needed", path)
    form_given = writing or Writing()
    return make_quaternions(table, form_given), labels, find_precision(table, form_given)


def _places(
    header: list[str],
    columns: Sequence[str] | None,
    known: tuple[tuple[str, ...], ...],
    path: Path,
    line: int,
) -> list[int]:
    """Where the columns are."""
    options = (tuple(name.strip().lower() for name in columns),) if columns else known
    if columns and len(columns) != len(known[0]):
        raise InputError(
            Fault(f"{len(columns)} names; {len(known[0])} are needed", "route.orientations.columns")
        )
    wanted = next((c for c in options if all(name in header for name in c)), None)
    if wanted is None:
        needed = " or ".join(", ".join(option) for option in options[:1])
        others = "".join(f" (or {', '.join(option)})" for option in options[1:])
        message = f"the header has {', '.join(header)}; columns {needed}{others} are needed"
        raise make_fault(message, path, line)
    repeated = next((name for name in header if name and header.count(name) > 1), None)
    if repeated is not None:
        raise make_fault(f'the header names "{repeated}" more than once', path, line)
    return [header.index(name) for name in wanted]


def _rows(path: Path) -> list[Row]:
    """Non-empty rows with the number of the line on which each ends."""
    lines = read_text(path).splitlines(keepends=True)
    comments = 0
    while comments < len(lines) and (not lines[comments].strip() or lines[comments].lstrip().startswith("#")):
        comments += 1
    first = lines[comments].strip() if comments < len(lines) else ""
    reader = csv.reader(
        io.StringIO("".join(lines[comments:]), newline=""),
        delimiter=next((s for s in SEPARATORS if s in first), ","),
        skipinitialspace=True,
        strict=True,
    )
    rows: list[Row] = []
    try:
        rows.extend((comments + reader.line_num, row) for row in reader if any(cell.strip() for cell in row))
    except csv.Error as error:
        raise make_fault(f"not readable as CSV: {error}", path, comments + reader.line_num) from None
    return rows


def _numbers(row: list[str], places: list[int], path: Path, line: int, writing: Writing) -> list[float]:
    if len(row) <= max(places):
        raise make_fault(f"{len(row)} values; {max(places) + 1} are needed", path, line)
    numbers = [read_number(row[i], path, line) for i in places]
    wrong = find_fault(numbers, writing)
    if wrong:
        raise make_fault(wrong, path, line)
    return numbers


def read_number(cell: str, path: Path, line: int) -> float:
    """A cell as a number that can be reckoned with."""
    text = cell.strip()
    if not NUMBER.fullmatch(text):
        raise make_fault(f'"{text}" is not a number', path, line)
    if not abs(value := float(text)) <= MOST:
        raise make_fault(f'"{text}" is out of range; {MOST:g} at most is allowed', path, line)
    return value


def _labels(header: list[str], rows: list[Row], path: Path) -> tuple[str, ...] | None:
    if LABEL not in header:
        return None
    place = header.index(LABEL)
    seen: dict[str, int] = {}
    for line, row in rows:
        label = row[place].strip() if place < len(row) else ""
        if not label or label in seen:
            raise make_fault(
                f'label "{label}" stands in line {seen[label]} too' if label else "no label", path, line
            )
        seen[label] = line
    return tuple(seen)


def make_fault(message: str, path: Path, line: int | None = None) -> InputError:
    """What is wrong with a table, and where."""
    return InputError(Fault(message, "", str(path), line, 1 if line is not None else None))
