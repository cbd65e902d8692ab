"""The tables of results: `python -m timelaw.reproduce.reference_tables PAGE PROBLEM.yaml …`.

Every number comes from designing anew: the problem files for the reference results, and every lattice
and tour under one set of limits, by the easing that is the default, for what tours are worth.
The tables between their marks are replaced.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from timelaw.pipeline import Design, design, design_problem
from timelaw.problem.load import check_problem, load_problem
from timelaw.problem.source import read
from timelaw.report import list_law_rows
from timelaw.reproduce.command import run_main
from timelaw.time_law.baselines import DOUBLE_S, EVERY_STOP, QUINTIC
from timelaw.time_law.time_law import OPTIMISED_LAW

MARK = "reference results"
HEADINGS = (
    "problem",
    "legs",
    "nodes passed",
    "quintic [s]",
    "double-S, every stop [s]",
    "optimised [s]",
    "physical limit [s]",
    "to quintic",
    "to limit",
)


def table_references(designs: Sequence[Design]) -> str:
    """A Markdown table with one row per design."""
    return format_markdown(HEADINGS, [_cells(design) for design in designs])


def format_markdown(headings: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table: the first column to the left, the others to the right."""
    lines = ["| " + " | ".join(headings) + " |", "|---" + "|---:" * (len(headings) - 1) + "|"]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def list_tours(paths: Sequence[Path]) -> list[Path]:
    """Problem files whose motion is along the arcs of a tour: what passes the nodes has tables of its own."""
    problems = {path: load_problem(path)[0] for path in paths}
    return [path for path, p in problems.items() if p.route.bezier is None and not p.motion.through]


def _cells(design: Design) -> list[str]:
    rows = {row.name: row for row in list_law_rows(design)}
    best, through = rows[OPTIMISED_LAW], rows[DOUBLE_S]
    stopping = rows.get(EVERY_STOP, through)
    return [
        design.problem.name,
        str(len(design.route.legs)),
        str(len(design.route.legs) - len(design.requirements.runs(design.route))),
        f"{rows[QUINTIC].duration:.2f}",
        f"{stopping.duration:.2f}",
        f"**{best.duration:.2f}**",
        f"{design.limit:.2f}",
        f"{best.to_quintic:.3f}",
        f"{best.to_limit:.3f}",
    ]


def replace_table(text: str, new: str, mark: str = MARK) -> str:
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


TOUR_MARK = "tours"
TOURS = {
    "16-cell": ("shortest",),
    "tesseract": ("shortest",),
    "24-cell": ("paper", "shortest", "fewest-stops", "least-turning"),
    "600-cell": ("shortest", "fewest-stops", "least-turning"),
    "120-cell": ("shortest",),
}
PROBLEM = """\
timelaw: 1
name: {lattice}-{tour}
route: {{orientations: {{lattice: {lattice}}}, tour: {tour}}}
limits: {{velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}}
"""
TOUR_HEADINGS = (
    "lattice",
    "tour",
    "legs",
    "straight nodes",
    "axis turns",
    "quintic [s]",
    "double-S, every stop [s]",
    "double-S over runs [s]",
    "optimised [s]",
)


def design_tours() -> list[tuple[str, str, Design]]:
    """(lattice, tour, its design), in the order of the table."""
    found = []
    for lattice, tours in TOURS.items():
        for tour in tours:
            source = read(PROBLEM.format(lattice=lattice, tour=tour), "<table>")
            found.append((lattice, tour, design_problem(Path("table.yaml"), check_problem(source), source)))
    return found


def table_tours(rows: Sequence[tuple[str, str, Design]]) -> str:
    """A Markdown table with one row per lattice and tour."""
    return format_markdown(
        TOUR_HEADINGS, [[lattice, tour, *_tour_cells(design)] for lattice, tour, design in rows]
    )


def _tour_cells(design: Design) -> list[str]:
    times = {row.name: row.duration for row in list_law_rows(design)}
    turning = sum(node.turn for node in design.route.nodes[1:-1])
    return [
        str(len(design.route.legs)),
        str(design.route.straight_nodes),
        f"{np.degrees(turning):.0f}°",
        f"{times[QUINTIC]:.2f}",
        f"{times.get(EVERY_STOP, times[DOUBLE_S]):.2f}",
        f"{times[DOUBLE_S]:.2f}",
        f"**{times[OPTIMISED_LAW]:.2f}**",
    ]


def main(arguments: Sequence[str]) -> None:
    """Design everything and rewrite both tables."""
    page, *problems = map(Path, arguments)
    text = replace_table(
        page.read_text(encoding="utf-8"), table_references([design(path) for path in list_tours(problems)])
    )
    page.write_text(replace_table(text, table_tours(design_tours()), TOUR_MARK), encoding="utf-8")


if __name__ == "__main__":
    run_main(main)
