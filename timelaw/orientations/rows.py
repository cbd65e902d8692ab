"""The rows of a text table: cells, each with its line, and nothing that could be read in two ways."""

import csv
import io
import re
from collections.abc import Collection
from pathlib import Path

from timelaw.errors import Fault, InputError, shorten
from timelaw.files import read_text
from timelaw.orientations.headers import find_commented_header
from timelaw.units import MOST

MAX_BYTES = 50_000_000
MOST_LINES = 500_000  # a map of half a million points takes 5 s and 600 MB
MOST_CELLS = 5_000_000  # of a table, which is held whole
MOST_COLUMNS = 1000  # whose names are looked for
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?")
SEPARATORS = (";", ",", "\t", " ")  # the first of them in the first row; commas beside ; are in the numbers
EMPTY_ROW = "an empty row; fill it in or take it out, for rows are numbered"

Row = tuple[int, list[str]]


def read_rows(path: Path, names: Collection[str] = ()) -> list[Row]:
    """Rows of cells without blanks around them, with the number of the line on which each ends.

    Comments stand before the first row; the last of them may be its header, if the `names` that are looked
    for, or those of an orientation, are in it and the first row is all numbers. Empty lines are none; a row
    of empty cells is refused, for nobody can tell whether it counts. A row has as many cells as the first,
    empty ones at the end apart.

    Raises:
        InputError: with file, line and what is needed.
    """
    text = read_lines(path)
    lines = list(io.StringIO(text, newline=""))
    comments = 0
    while comments < len(lines) and (not lines[comments].strip() or lines[comments].lstrip().startswith("#")):
        comments += 1
    first = lines[comments].strip() if comments < len(lines) else ""
    separator = next((s for s in SEPARATORS if s in first), ",")
    _refuse_more(text.count(separator) + len(lines), MOST_CELLS, "cells", path)
    _refuse_more(first.count(separator) + 1, MOST_COLUMNS, "columns", path)
    rows = _split(lines, comments, separator, path)
    _refuse_other_widths(rows, path)
    if comments and rows and all(NUMBER.fullmatch(cell) for cell in rows[0][1] if cell):
        header = find_commented_header(lines[:comments], separator, measure_width(rows), names)
        rows = rows if header is None else [(comments, header), *rows]
    return rows


def read_lines(path: Path) -> str:
    """The text of a table of at most so many lines, which are counted before they are told apart.

    Raises:
        InputError: it has more, or cannot be read.
    """
    text = read_text(path, MAX_BYTES)
    _refuse_more(max(text.count("\n"), text.count("\r")), MOST_LINES, "lines", path)
    return text


def _refuse_more(count: int, most: int, what: str, path: Path) -> None:
    if count > most:
        raise make_fault(f"{count} {what}; at most {most} are allowed", path)


def _split(lines: list[str], comments: int, separator: str, path: Path) -> list[Row]:
    """The lines after the comments as rows."""
    reader = csv.reader(lines[comments:], delimiter=separator, skipinitialspace=True, strict=True)
    rows: list[Row] = []
    start, blank = comments, 0
    try:
        for row in reader:
            line, text = comments + reader.line_num, lines[start]
            start = line
            cells = [cell.strip() for cell in row]
            if not any(cells):
                blank = blank or (line if text.strip("\r\n") else 0)
                if len(cells) < 2:
                    continue  # refused if anything comes after it
            if blank:
                raise make_fault(EMPTY_ROW, path, blank)
            if text.lstrip().startswith("#"):
                message = "comments stand before the first row; a label that starts with # needs quotes"
                raise make_fault(message, path, line)
            rows.append((line, cells))
    except csv.Error as error:
        raise make_fault(f"not readable as CSV: {error}", path, comments + reader.line_num) from None
    return rows


def _refuse_other_widths(rows: list[Row], path: Path) -> None:
    """A row with a cell too few or too many puts the cells after it into other columns."""
    most = len(rows[0][1]) if rows else 0
    least = measure_width(rows[:1])
    for line, cells in rows:
        if len(cells) < least:
            raise make_fault(f"{len(cells)} values; {least} are needed", path, line)
        if any(cells[most:]):
            message = f"{measure_width([(line, cells)])} values; {most} are needed, with decimal points"
            raise make_fault(message, path, line)


def measure_width(rows: list[Row]) -> int:
    """How many columns there are, those at the end that are empty in all rows apart."""
    return max((i + 1 for _, cells in rows for i, cell in enumerate(cells) if cell), default=0)


def read_number(cell: str, path: Path, line: int) -> float:
    """A cell as a number that can be reckoned with."""
    text = cell.strip()
    if not NUMBER.fullmatch(text):
        hint = "; a decimal point is needed" if NUMBER.fullmatch(text.replace(",", ".", 1)) else ""
        raise make_fault(f'"{shorten(text)}" is not a number{hint}', path, line)
    if not abs(value := float(text)) <= MOST:
        raise make_fault(f'"{shorten(text)}" is out of range; {MOST:g} at most is allowed', path, line)
    return value


def make_fault(message: str, path: Path, line: int | None = None) -> InputError:
    """What is wrong with a table, and where."""
    return InputError(Fault(message, "", str(path), line, 1 if line is not None else None))
