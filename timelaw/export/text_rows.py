"""Rows of numbers as text, block by block: the whole of a long table never stands in memory."""

from collections.abc import Callable, Iterator

import numpy as np

from timelaw.numerics.array import Array

BLOCK = 8192  # rows that are made together


def cut_rows(count: int) -> Iterator[slice]:
    """So many rows in blocks."""
    return (slice(first, min(first + BLOCK, count)) for first in range(0, count, BLOCK))


def format_table(
    t: Array, tabulate: Callable[[Array], Array], cell: str, separator: str = " "
) -> Iterator[str]:
    """Rows at instants t (m,): `tabulate` gives the numbers (b, w) of a block, `cell` the form of each."""
    for block in cut_rows(len(t)):
        with np.errstate(all="ignore"):  # what a hostile law overflows is not finite in the file
            rows = tabulate(t[block])
        yield format_rows(rows, [separator.join([cell] * rows.shape[1]) + "\n"] * len(rows))


def format_rows(rows: Array, formats: list[str]) -> str:
    """Numbers (m, w) by the format of each row, all at once: in half the time of row by row."""
    return "".join(formats) % tuple((rows + 0.0).ravel().tolist())
