"""Tables of text as wide as they are: a terminal folds what is too long for it, and nothing is cut."""

import unicodedata
from collections.abc import Sequence

BETWEEN = "  "  # columns


def format_table(headings: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Headings over a rule over rows: the first column to the left, the others, numbers, to the right."""
    cells = [[_show(cell) for cell in row] for row in (headings, *rows)]
    widths = [max(map(_measure, column)) for column in zip(*cells, strict=True)]
    head, *body = (BETWEEN.join(map(_place, row, widths, range(len(row)))).rstrip() for row in cells)
    rule = "─" * (sum(widths) + len(BETWEEN) * (len(widths) - 1))
    return "\n".join(["", *(f" {line}" for line in (head, rule, *body)), ""])


def _place(cell: str, width: int, column: int) -> str:
    blank = " " * (width - _measure(cell))
    return blank + cell if column else cell + blank


def _show(cell: str) -> str:
    """Without what would move the cursor; labels may hold anything."""
    return "".join(letter if letter.isprintable() else " " for letter in cell)


def _measure(cell: str) -> int:
    """How many places a terminal gives it: two for letters of the east, none for what stands on others."""
    wide = sum(unicodedata.east_asian_width(letter) in "WF" for letter in cell)
    return len(cell) + wide - sum(bool(unicodedata.combining(letter)) for letter in cell)
