"""The README's table of reference results: `python -m timelaw.report.reference README.md PROBLEM.yaml …`.

Every number comes from designing the problem files anew; the table between the two marks is replaced.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

from timelaw.pipeline import Design, design
from timelaw.report.summary import law_rows
from timelaw.requirements.route_limit import limit_route

MARK = "reference results"
HEADINGS = (
    "problem",
    "legs",
    "straight nodes",
    "quintic [s]",
    "double-S, every stop [s]",
    "optimised [s]",
    "physical limit [s]",
    "to quintic",
    "to limit",
)


def table(designs: Sequence[Design]) -> str:
    """A Markdown table with one row per design."""
    return markdown(HEADINGS, [_cells(design) for design in designs])


def markdown(headings: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table: the first column to the left, the others to the right."""
    lines = ["| " + " | ".join(headings) + " |", "|---" + "|---:" * (len(headings) - 1) + "|"]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def _cells(design: Design) -> list[str]:
    rows = {row.name: row for row in law_rows(design)}
    best, through = rows["optimised"], rows["double-S"]
    stopping = rows.get("double-S, every stop", through)
    return [
        design.problem.name,
        str(len(design.route.legs)),
        str(design.route.straight_nodes),
        f"{rows['quintic'].duration:.2f}",
        f"{stopping.duration:.2f}",
        f"**{best.duration:.2f}**",
        f"{limit_route(design.route, design.requirements):.2f}",
        f"{best.to_quintic:.3f}",
        f"{best.to_limit:.3f}",
    ]


def replaced(text: str, new: str, mark: str = MARK) -> str:
    """The text with the table between the marks replaced.

    Raises:
        ValueError: the marks are not there.
    """
    begin, end = f"<!-- {mark}: begin -->", f"<!-- {mark}: end -->"
    before, _, rest = text.partition(begin)
    _, found, after = rest.partition(end)
    if not found:
        raise ValueError(f"no {begin} and {end}")
    return f"{before}{begin}\n{new}\n{end}{after}"


def main(arguments: Sequence[str]) -> None:
    """Design all problem files and rewrite the table."""
    readme, *problems = map(Path, arguments)
    new = table([design(path) for path in problems])
    readme.write_text(replaced(readme.read_text(encoding="utf-8"), new), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
