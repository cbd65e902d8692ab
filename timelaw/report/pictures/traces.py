"""The traces of the body axes on the unit sphere, figure 2 of [MMB2017], and marks at steps of time."""

from typing import Any

from timelaw.motion import QuaternionLaw
from timelaw.report.figures.style import AXIS_COLOURS, INK, MUTED
from timelaw.report.pictures.sampling import MOST_LEGS, count_shown, find_last_shown, list_marks, sample_times
from timelaw.report.pictures.sketch import SIZE, WIDTH, draw_dots, draw_globe, draw_path, make_panel
from timelaw.report.pictures.view import View

MANY = 60  # legs; lines of more are thin, and not dashed on the far side
WOOL = 120.0  # opaque lines that the thin ones amount to
EDGE = 1.08  # of the panel, in radii of the globe
FOOT = 0.3  # inch below the globe, for what the marks are


def draw_traces(law: QuaternionLaw) -> Any:
    """Figure: where each body axis points in the world, nodes as large dots, steps of time as small ones."""
    view, many = View(), len(law.legs) > MANY
    figure, ax = make_panel(WIDTH, WIDTH + FOOT)
    draw_globe(ax, view)
    step, marks = list_marks(law)
    times = sample_times(law)
    path = law.rotation(times[times <= find_last_shown(law)])
    nodes, ticks = (law.rotation(law.times), law.rotation(marks)) if not many else (path[:0], path[:0])
    for axis, colour in enumerate(AXIS_COLOURS):
        if many:
            thin = min(WOOL / min(len(law.legs), MOST_LEGS), 1.0)
            draw_path(ax, path[:, :, axis], view, colour, 0.4, dashed=False, alpha=thin)
        else:
            draw_path(ax, path[:, :, axis], view, colour, 1.2, dashed=True)
            draw_dots(ax, nodes[:, :, axis], view, colour, 22)
            draw_dots(ax, ticks[:, :, axis], view, colour, 5)
        letter = {"color": colour, "fontsize": 10, "weight": "bold", "ha": "left", "va": "top"}
        ax.text(-1.04 + 0.12 * axis, 1.05, "xyz"[axis], **letter)
    ax.set_xlim(-EDGE, EDGE)
    ax.set_ylim(-EDGE * (1 + 2 * FOOT / WIDTH), EDGE)
    told = count_shown(law) if many else f"large dots: nodes; small dots: every {step:g} s"
    ax.text(0, -EDGE * (1 + FOOT / WIDTH), told, ha="center", va="center", fontsize=SIZE, color=MUTED)
    ax.text(1.04, 1.05, f"{law.duration:.4g} s", ha="right", va="top", fontsize=SIZE, color=INK)
    return figure


def describe_traces(law: QuaternionLaw) -> str:
    """What is seen, for who does not see it."""
    return (
        f"The paths of the three body axes on the unit sphere over {law.duration:.6g} s and "
        f"{count_shown(law)}: x red, y blue, z green; the far side is fainter."
    )
