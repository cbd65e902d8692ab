"""A table of measurements, and how its cells are written."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from timelaw.reproduce.reference_tables import format_markdown

MISSING = "not installed"


@dataclass(frozen=True)
class Table:
    """What a part found: columns, rows, and sentences that stand below them."""

    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()


def format_block(table: Table, machine: str, *, quick: bool) -> str:
    """Markdown: the table, what it was measured on, and its notes as a list."""
    extent = "the quick run" if quick else "the full run"
    lines = [format_markdown(table.headings, table.rows), "", f"Measured by {extent} on {machine}."]
    if table.notes:
        lines += ["", *(f"- {note}" for note in table.notes)]
    return "\n".join(lines)


def format_spread(values: Sequence[float], unit: float = 1.0) -> str:
    """Median, least and most of what was measured, in parts of a unit; of a single value itself."""
    middle, least, most = (float(f(values)) / unit for f in (np.median, np.min, np.max))
    if len(values) == 1:
        return format_number(middle)
    return f"{format_number(middle)} ({format_number(least)}–{format_number(most)})"


def format_number(value: float) -> str:
    """Three digits, without an exponent where it is not very small or large."""
    return f"{float(f'{value:.3g}'):g}"


def format_ratio(values: Sequence[float], others: Sequence[float]) -> str:
    """The ratio of the medians, three digits."""
    return format_number(float(np.median(values)) / float(np.median(others)))
