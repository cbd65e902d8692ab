"""Orientation tables: CSV with a header that names the columns, or plain numbers in a named form."""

from pathlib import Path
from typing import NamedTuple

from timelaw.errors import shorten
from timelaw.files import LONGEST_LABEL
from timelaw.numerics.array import Array
from timelaw.orientations.columns import Columns, find_columns
from timelaw.orientations.forms import (
    FORMS,
    Writing,
    describe_translations,
    find_fault,
    find_precision,
    make_quaternions,
)
from timelaw.orientations.headers import describe_places
from timelaw.orientations.precision import Precision
from timelaw.orientations.rows import Row, make_fault, measure_width, read_number, read_rows

LABEL = "label"


class Table(NamedTuple):
    """Unit quaternions (N, 4), labels if there is a column `label`, the precision, what is left alone."""

    quaternions: Array
    labels: tuple[str, ...] | None
    precision: Precision
    notes: tuple[str, ...]


def read_table(path: Path, writing: Writing | None = None, columns: Columns | None = None) -> Table:
    """The orientations of a text table.

    Columns are found by name in any order, those of the form (w, x, y, z or qw, qx, qy, qz for
    quaternions), or the `columns` given, by name or counted from 1; others are left alone. Where a form
    is given, a table of just its columns needs no header. Values are separated by commas, semicolons,
    tabs or blanks. Lines before the first row that start with # are comments; the last may be the header.

    Raises:
        InputError: with file, line and what is needed.
    """
    form = FORMS[writing.form if writing else "wxyz"]
    names = tuple(name for name in columns or () if isinstance(name, str))
    rows = read_rows(path, names)
    if not rows:
        needed = ",".join(map(str, columns or form.columns[0]))
        raise make_fault(f"no rows; a header {needed} and a row per orientation are needed", path)
    places, headed = find_columns(rows, form, columns, path, named=writing is not None)
    header = rows[0][1] if headed else []
    rows = rows[1:] if headed else rows
    labels = _labels([name.lower() for name in header], rows, path)
    table = [_numbers(row, places, path, line, writing or Writing()) for line, row in rows]
    if len(table) < 2:
        raise make_fault(f"{len(table)} orientations; at least two are needed", path)
    form_given = writing or Writing()
    notes = describe_translations(table, form_given, path.name)
    notes += describe_places(header, places, measure_width(rows), path.name)
    return Table(make_quaternions(table, form_given), labels, find_precision(table, form_given), notes)


def _numbers(row: list[str], places: list[int], path: Path, line: int, writing: Writing) -> list[float]:
    if len(row) <= max(places):
        raise make_fault(f"{len(row)} values; {max(places) + 1} are needed", path, line)
    numbers = [read_number(row[i], path, line) for i in places]
    wrong = find_fault(numbers, writing)
    if wrong:
        raise make_fault(wrong, path, line)
    return numbers


def _labels(header: list[str], rows: list[Row], path: Path) -> tuple[str, ...] | None:
    if LABEL not in header:
        return None
    if header.count(LABEL) > 1:
        raise make_fault(f'the header names "{LABEL}" more than once', path)
    place = header.index(LABEL)
    seen: dict[str, int] = {}
    for line, row in rows:
        label = row[place] if place < len(row) else ""
        if not label or label in seen:
            raise make_fault(
                f'label "{shorten(label)}" stands in line {seen[label]} too' if label else "no label",
                path,
                line,
            )
        if len(label) > LONGEST_LABEL:
            message = f"a label of {len(label)} characters; at most {LONGEST_LABEL} are allowed"
            raise make_fault(message, path, line)
        seen[label] = line
    return tuple(seen)
