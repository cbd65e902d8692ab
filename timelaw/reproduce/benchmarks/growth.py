"""How time grows with size: the columns of the page's tables that say so, as a picture beside the page."""

import re
from collections.abc import Sequence
from pathlib import Path

from timelaw.report.figures.growth import draw_growth

NAME = "growth.svg"
LINES = {  # what is drawn: the table's mark, its column
    "design, whole command": ("routes", "whole command, CPU [s]"),
    "least times, legs by themselves": ("routes", "CPU [s]"),
    "least jerk, all legs in one program": ("coupled", "CPU [s]"),
    "shortest tour and its bound": ("tours", "CPU [s]"),
}
ONLY = {"coupled": ("degree", "9")}  # rows that have this in a column
NUMBER = re.compile(r"[\d.]+(?:e[+-]?\d+)?")  # at the start of a cell; spread may follow


def draw_page(page: Path) -> None:
    """Draw what the tables of a page say, into its folder."""
    text = page.read_text(encoding="utf-8")
    lines = {
        label: points
        for label, (mark, column) in LINES.items()
        if (points := read_points(text, mark, column))
    }
    if lines:
        folder = page.parent / page.stem
        folder.mkdir(exist_ok=True)
        (folder / NAME).write_text(draw_growth(lines), encoding="utf-8")


def read_points(text: str, mark: str, column: str) -> list[tuple[float, float]]:
    """(first column, that column) of the table between the marks; cells that are no numbers are left out."""
    points = []
    headings, *rows = read_rows(text, mark) or [[]]
    for row in rows:
        cells = dict(zip(headings, row, strict=True))
        key, value = ONLY.get(mark, (headings[0], row[0]))
        found = NUMBER.match(cells[column])
        if found and cells[key] == value:
            points.append((float(row[0]), float(found[0])))
    return sorted(points)


def read_rows(text: str, mark: str) -> list[Sequence[str]]:
    """The cells of the table between the marks, its headings first; none if it is not there."""
    block = text.partition(f"<!-- {mark}: begin -->")[2].partition(f"<!-- {mark}: end -->")[0]
    lines = [line for line in block.splitlines() if line.startswith("|") and not line.startswith("|---")]
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]
