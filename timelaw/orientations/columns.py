"""Which columns of a table hold the orientations: by name, by number, or all of them."""

from collections.abc import Sequence
from pathlib import Path
from typing import cast

from timelaw.errors import Fault, InputError, shorten
from timelaw.orientations.forms import Form
from timelaw.orientations.headers import clean_name
from timelaw.orientations.rows import NUMBER, Row, make_fault, measure_width

NUMBERED = (("q1", "q2", "q3", "q4"), ("q0", "q1", "q2", "q3"))
WHERE = "route.orientations.columns"
NO_VALUE = ("", "nan", "na", "n/a", "inf", "infinity", "none", "null", "-", "--", "?")  # but no name either
Columns = Sequence[str] | Sequence[int]


def find_columns(
    rows: list[Row], form: Form, columns: Columns | None, path: Path, *, named: bool
) -> tuple[list[int], bool]:
    """Places of a form's numbers, counted from 0, and whether the first row is a header.

    `named` says that the form was chosen by name: only then may a table do without a header, and only
    if it has no other columns or `columns` says which.

    Raises:
        InputError: columns that are not there, or that could be read in two ways.
    """
    if columns is not None and len(columns) not in form.widths:
        kind = "names" if isinstance(columns[0], str) else "numbers"
        raise InputError(Fault(f"{len(columns)} {kind}; {form.width} are needed", WHERE))
    line, cells = rows[0]
    header = [clean_name(cell) for cell in cells]
    if columns is not None and isinstance(columns[0], int):
        return _by_number(rows, form, cast(Sequence[int], columns), path)
    if columns is None and named and all(NUMBER.fullmatch(name) for name in header if name):
        return list(range(_count_columns(rows, form, path))), False
    places = _by_name(header, form, cast(Sequence[str] | None, columns), path, line, named=named)
    _refuse_another_order(form, [header[i] for i in places])
    return places, True


def _by_name(
    header: list[str], form: Form, columns: Sequence[str] | None, path: Path, line: int, *, named: bool
) -> list[int]:
    """Where the names stand in the header."""
    options = (tuple(clean_name(name) for name in columns),) if columns else form.columns
    if form.numbered and columns is None:
        options += _find_numbered(header, path, line, named=named)
    found = [option for option in options if all(name in header for name in option)]
    if not found:
        needed = ", ".join(options[0])
        others = "".join(f" (or {', '.join(option)})" for option in options[1:])
        message = f"the header has {shorten(', '.join(header))}; columns {needed}{others} are needed"
        numbers = [i + 1 for i, name in enumerate(header) if NUMBER.fullmatch(name)]
        if named and columns is None and len(numbers) >= form.width:
            message += f"; without a header give columns: {numbers[-form.width :]}, counted from 1"
        raise make_fault(message, path, line)
    repeated = next((name for name in header if name and header.count(name) > 1), None)
    if repeated is not None:
        raise make_fault(f'the header names "{shorten(repeated)}" more than once', path, line)
    if len(found) > 1:
        both = " and ".join(", ".join(option) for option in found)
        raise make_fault(f'the header has {both}; choose by the key "columns"', path, line)
    return [header.index(name) for name in found[0]]


def _find_numbered(header: list[str], path: Path, line: int, *, named: bool) -> tuple[tuple[str, ...], ...]:
    """Components called by numbers, whose order only a form that is chosen by name says."""
    there = tuple(names for names in NUMBERED if set(names) <= set(header))
    if there and not named:
        listing = ", ".join(there[0])
        message = f"columns {listing} have the scalar first for some makers and last for others"
        raise make_fault(f'{message}; say which: "as: wxyz" or "as: xyzw"', path, line)
    return there


def _by_number(rows: list[Row], form: Form, columns: Sequence[int], path: Path) -> tuple[list[int], bool]:
    """Columns counted from 1; the first row is a header if it names them."""
    width = measure_width(rows)
    if max(columns) > width:
        raise InputError(Fault(f"{max(columns)}; {path.name} has {width} columns", WHERE))
    places = [number - 1 for number in columns]
    line, cells = rows[0]
    first = [cells[i] if i < len(cells) else "" for i in places]
    if all(NUMBER.fullmatch(cell) for cell in first):
        return places, False
    odd = next((cell for cell in first if _is_value(cell)), None)
    if odd is not None:
        listing, odd = shorten(", ".join(first)), shorten(odd)
        message = f'columns {list(columns)} of the first row are {listing}: "{odd}" is no name of a column'
        raise make_fault(f"{message}, and not all of them are numbers", path, line)
    _refuse_another_order(form, [clean_name(cell) for cell in first])
    return places, True


def _is_value(cell: str) -> bool:
    """Whether a cell stands for a number, also for one that is missing or cannot be read."""
    return cell.lower() in NO_VALUE or cell[0] in "+-.,0123456789"


def _count_columns(rows: list[Row], form: Form, path: Path) -> int:
    """How many columns a table without a header has; nothing says which of too many are meant."""
    width, line = measure_width(rows), rows[0][0]
    if width < form.width:
        raise make_fault(f"{width} values; {form.width} are needed", path, line)
    ways = list(range(width - form.width + 1, width + 1))
    if width not in form.widths:
        message = f"{width} columns and no header; {form.width} are needed for {form.name}"
        raise make_fault(f"{message}: name them, or give columns: {ways}, counted from 1", path, line)
    first = rows[0][1]
    if first == [str(i) for i in range(width)]:
        message = f"{', '.join(first)} may be numbers of columns or an orientation"
        names = ", ".join(f'"{name}"' for name in first)
        raise make_fault(f"{message}: give columns: [{names}], or columns: {ways}", path, line)
    return width


def _refuse_another_order(form: Form, names: list[str]) -> None:
    """A quaternion's w where the form has another number."""
    given = [name.removeprefix("q") for name in names]
    wanted = form.columns[0]
    if "w" in wanted and "w" in given and given.index("w") != wanted.index("w"):
        other = "xyzw" if wanted[0] == "w" else "wxyz"
        order = ", ".join(names)
        message = f'{order} is another order than {", ".join(wanted)}; as: {other}, or order "columns" so'
        raise InputError(Fault(message, WHERE))
