"""The body at the nodes, one small picture each, as figure 1 of [MMB2017] shows it."""

from math import ceil
from typing import Any

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.report.figures.style import INK, MUTED
from timelaw.report.pictures.sketch import SIZE, WIDTH, draw_box, make_panel
from timelaw.report.pictures.view import View, size_box

COLUMNS = 4
MOST = 24  # bodies; the first of more are shown
CELL, HEAD = 2.0, 0.5  # a body and its label, in radii of the sphere that its axes reach
LONGEST = 14  # characters of a label that fit above a body


def draw_frames(law: QuaternionLaw) -> Any:
    """Figure: the body as a box with its axes at each node, visit by visit, with label and time."""
    view, half = View(), size_box(law.shape)
    visits = list_visits(law)
    shown = visits[:MOST]
    columns = min(COLUMNS, len(shown))
    rows = ceil(len(shown) / columns)
    more = 0.4 if len(shown) < len(visits) else 0.0
    across, down = CELL * columns, (CELL + HEAD) * rows + more
    figure, ax = make_panel(WIDTH, WIDTH * down / across)
    rotations = law.rotation([time for _, time in shown])
    for k, ((label, time), rotation) in enumerate(zip(shown, rotations, strict=True)):
        row, column = divmod(k, columns)
        centre = np.array([CELL * (column + 0.5), -(CELL + HEAD) * (row + 0.5) - HEAD / 2])
        draw_box(ax, rotation, half, view, centre, 0.92)
        above = {"va": "center", "fontsize": SIZE, "parse_math": False}
        name = label if len(label) <= LONGEST else label[: LONGEST - 1] + "…"
        ax.text(centre[0] - 0.9, centre[1] + 1.2, name, color=INK, weight="bold", ha="left", **above)
        if len(name) < LONGEST // 2:
            ax.text(centre[0] + 0.9, centre[1] + 1.2, f"{time:.4g} s", color=MUTED, ha="right", **above)
    if more:
        told = f"the first {len(shown)} of {len(visits)} nodes"
        ax.text(across / 2, -down + 0.2, told, ha="center", va="center", fontsize=SIZE, color=MUTED)
    ax.set_xlim(0, across)
    ax.set_ylim(-down, 0)
    return figure


def list_visits(law: QuaternionLaw) -> list[tuple[str, float]]:
    """Label and time [s] of each node in turn, a rest at it counted once."""
    visits = list(zip(law.labels, law.times.tolist(), strict=True))
    return [
        visits[0],
        *(v for v, segment in zip(visits[1:], law.segments, strict=True) if segment.moves),
    ]


def describe_frames(law: QuaternionLaw) -> str:
    """What is seen, for who does not see it."""
    labels = [label for label, _ in list_visits(law)[:MOST]]
    return f"The body as a box with its axes at the nodes {', '.join(labels)}."
