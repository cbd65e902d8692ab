"""Parts that several pictures draw: a square panel, the globe, paths on it, a box with its axes."""

from typing import Any

import numpy as np

from timelaw.numerics.array import Array
from timelaw.report.figures.style import AXIS_COLOURS, GRID_LINE, INK, PAPER
from timelaw.report.pictures.view import View, list_circles, list_faces, split_sides

WIDTH = 3.95  # inch; on a phone as wide as the page, its labels not smaller than they are made
SIZE = 8.5  # of labels, in points
STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": SIZE,
    "svg.fonttype": "none",
    "lines.solid_joinstyle": "round",
    "lines.solid_capstyle": "round",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "legend.frameon": False,
}
FAR = (0, (2.5, 2.0))  # dashes of what is behind the sphere


def make_panel(width: float = WIDTH, height: float = WIDTH) -> tuple[Any, Any]:
    """A figure [inch] and its one panel, all of it, whose units are alike in both directions."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height))
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set_axis_off()
    ax.set_aspect("equal")
    return figure, ax


def draw_globe(ax: Any, view: View) -> None:
    """Meridians and parallels of the unit sphere, the far half fainter, and its outline."""
    for circle in list_circles():
        near, far = split_sides(view.project(circle))
        ax.plot(*far.T, color=GRID_LINE, alpha=0.5, linewidth=0.4, zorder=0)
        ax.plot(*near.T, color=GRID_LINE, linewidth=0.5, zorder=1)
    ring = np.linspace(0.0, 2 * np.pi, 121)
    ax.plot(np.cos(ring), np.sin(ring), color=GRID_LINE, linewidth=0.8, zorder=1)


def draw_path(
    ax: Any, points: Array, view: View, colour: str, width: float, *, dashed: bool, alpha: float = 1.0
) -> None:
    """A path (m, 3) on the sphere, its far part fainter, and dashed where that can be seen."""
    near, far = split_sides(view.project(points))
    style = {"linestyle": FAR} if dashed else {}
    ax.plot(*far.T, color=colour, alpha=0.5 * alpha, linewidth=0.7 * width, zorder=2, **style)
    ax.plot(*near.T, color=colour, alpha=alpha, linewidth=width, zorder=4)


def draw_dots(ax: Any, points: Array, view: View, colour: str, size: float) -> None:
    """Points (m, 3) on the sphere: filled where they are near, rings where they are far."""
    projected = view.project(points)
    near = projected[:, 2] >= 0
    ax.scatter(*projected[near, :2].T, s=size, color=colour, linewidths=0, zorder=5)
    far = {"facecolors": PAPER, "edgecolors": (colour, 0.6), "linewidths": 0.6}
    ax.scatter(*projected[~near, :2].T, s=0.8 * size, zorder=3, **far)


def draw_box(ax: Any, rotation: Array, half: Array, view: View, centre: Array, reach: float) -> None:
    """A box (half edges (3,)) turned by R (3, 3), its axes as long as `reach`, about `centre` (2,)."""
    from matplotlib.patches import Polygon

    away = view.project(rotation.T)[:, 2] < 0
    for axis in range(3):
        ends = view.project(np.stack([half[axis] * rotation[:, axis], reach * rotation[:, axis]]))[:, :2]
        style = {"color": AXIS_COLOURS[axis], "linewidth": 1.1, "zorder": 6 if away[axis] else 8}
        ax.plot(*(ends + centre).T, **style)
        ax.scatter(*(ends[1] + centre), s=5, color=AXIS_COLOURS[axis], linewidths=0, zorder=style["zorder"])
    for face in list_faces(rotation, half, view):
        tint = AXIS_COLOURS[face.axis] if face.sense > 0 else INK
        part = 0.25 + 0.35 * face.facing if face.sense > 0 else 0.06 + 0.14 * face.facing
        corners = view.project(face.corners)[:, :2] + centre
        ax.add_patch(Polygon(corners, closed=True, zorder=7, facecolor=PAPER, linewidth=0))
        drawn = {"facecolor": (tint, part), "edgecolor": INK, "linewidth": 0.6, "joinstyle": "round"}
        ax.add_patch(Polygon(corners, closed=True, zorder=7, **drawn))
