"""The README's table of what tours are worth: `python -m timelaw.report.tour_table README.md`.

Every lattice and tour designed anew under one set of limits, all legs by polynomials of degree 9.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from timelaw.pipeline import Design, design_problem
from timelaw.problem.load import check
from timelaw.problem.source import read
from timelaw.report.reference import markdown, replaced
from timelaw.report.summary import law_rows

MARK = "tours"
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
HEADINGS = (
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


def designs() -> list[tuple[str, str, Design]]:
    """(lattice, tour, its design), in the order of the table."""
    found = []
    for lattice, tours in TOURS.items():
        for tour in tours:
            source = read(PROBLEM.format(lattice=lattice, tour=tour), "<table>")
            found.append((lattice, tour, design_problem(Path("table.yaml"), check(source), source)))
    return found


def table(rows: Sequence[tuple[str, str, Design]]) -> str:
    """A Markdown table with one row per lattice and tour."""
    return markdown(HEADINGS, [[lattice, tour, *_cells(design)] for lattice, tour, design in rows])


def _cells(design: Design) -> list[str]:
    times = {row.name: row.duration for row in law_rows(design)}
    turning = sum(node.turn for node in design.route.nodes[1:-1])
    return [
        str(len(design.route.legs)),
        str(design.route.straight_nodes),
        f"{np.degrees(turning):.0f}°",
        f"{times['quintic']:.2f}",
        f"{times.get('double-S, every stop', times['double-S']):.2f}",
        f"{times['double-S']:.2f}",
        f"**{times['optimised']:.2f}**",
    ]


def main(arguments: Sequence[str]) -> None:
    """Design all of them and rewrite the table."""
    readme = Path(arguments[0])
    text = readme.read_text(encoding="utf-8")
    readme.write_text(replaced(text, table(designs()), MARK), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
