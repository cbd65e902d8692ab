"""The traces of the body axes on the unit sphere along a route, as figure 2 of [MMB2017] shows them."""

from typing import Any

import numpy as np

from timelaw.numerics.quaternion import rotation_matrix
from timelaw.report.figures.style import AXIS_COLOURS, GRID_LINE, render_svg, use_style
from timelaw.route import Route

AXES = tuple(zip("xyz", AXIS_COLOURS, strict=True))
POINTS_PER_LEG = 25
GRID: dict[str, Any] = {"color": GRID_LINE, "linewidth": 0.4, "zorder": 0}
VIEW = {"elev": 22.0, "azim": 35.0}


def draw_traces(name: str, route: Route) -> str:
    """SVG text: for each body axis its path in world coordinates, dots at the nodes."""
    from matplotlib.figure import Figure

    with use_style():
        figure = Figure(figsize=(9.4, 3.4), layout="constrained")
        legs = len(route.legs)
        path = rotation_matrix(route.orientation(np.linspace(0, legs, legs * POINTS_PER_LEG + 1)))
        nodes = rotation_matrix(route.orientation(np.arange(legs + 1.0)))
        for index, (axis, colour) in enumerate(AXES):
            ax: Any = figure.add_subplot(1, 3, index + 1, projection="3d")
            draw_globe(ax)
            ax.plot(*path[:, :, index].T, color=colour, linewidth=1.2)
            ax.scatter(*nodes[:, :, index].T, color=colour, s=10, depthshade=False)
            ax.set_title(f"body axis {axis}", fontsize=9)
        return render_svg(figure, name)


def draw_globe(ax: Any) -> None:
    """Parallels and meridians, thin."""
    angle = np.linspace(0, 2 * np.pi, 73)
    for latitude in np.radians([-60, -30, 0, 30, 60]):
        ring = np.cos(latitude)
        ax.plot(ring * np.cos(angle), ring * np.sin(angle), np.full(73, np.sin(latitude)), **GRID)
    for longitude in np.radians(np.arange(0, 180, 30)):
        ax.plot(np.cos(angle) * np.cos(longitude), np.cos(angle) * np.sin(longitude), np.sin(angle), **GRID)
    ax.set_box_aspect((1, 1, 1), zoom=1.35)
    ax.view_init(**VIEW)
    ax.set_axis_off()
