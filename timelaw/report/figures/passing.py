"""How a motion through the nodes bends the arcs: traces of the body axes, and the way it keeps from them."""

from typing import Any

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import rotation_matrix
from timelaw.pipeline import Design
from timelaw.report.figures.sphere import AXES, draw_globe
from timelaw.report.figures.style import (
    LIMIT,
    NODE,
    OPTIMISED,
    QUINTIC,
    describe_excerpt,
    list_first_legs,
    render_svg,
)

POINTS = 40  # of each leg


def draw_passing(design: Design) -> str:
    """The traces of both motions on the sphere, and the angle to the arcs over time."""
    from matplotlib.figure import Figure

    law, route = design.optimised.law, design.route
    legs = len([segment for segment in list_first_legs(law) if segment.moves])
    figure = Figure(figsize=(9.4, 5.4), layout="constrained")
    grid = figure.add_gridspec(2, 3, height_ratios=(3.0, 1.5))
    arcs = rotation_matrix(route.orientation(np.linspace(0, legs, legs * POINTS + 1)))
    nodes = rotation_matrix(route.orientation(np.arange(legs + 1.0)))
    times = np.linspace(0.0, list_first_legs(law)[-1].end_time, legs * POINTS + 1)
    path = law.rotation(times)
    for index, (axis, colour) in enumerate(AXES):
        ax: Any = figure.add_subplot(grid[0, index], projection="3d")
        draw_globe(ax)
        ax.plot(*arcs[:, :, index].T, color=QUINTIC, linewidth=0.8, linestyle=(0, (4, 2)))
        ax.plot(*path[:, :, index].T, color=colour, linewidth=1.3)
        ax.scatter(*nodes[:, :, index].T, color=colour, s=10, depthshade=False)
        ax.set_title(f"body axis {axis}", fontsize=9)
    _draw_deviation(figure.add_subplot(grid[1, :]), design)
    return render_svg(figure, "passing")


def _draw_deviation(ax: Any, design: Design) -> None:
    law = design.optimised.law
    times, angles = trace_deviation(law)
    ax.plot(times, np.degrees(angles), color=OPTIMISED, linewidth=1.3)
    bound = design.problem.motion.deviation
    if bound is not None:
        ax.axhline(np.degrees(bound), color=LIMIT, linewidth=1, linestyle=(0, (5, 3)))
    for segment in list_first_legs(law):
        ax.axvline(segment.start_time, color=NODE, linewidth=0.7, zorder=0)
    ax.set_ylim(bottom=0)
    ax.margins(x=0.005)
    ax.set_ylabel("angle to the arc  [deg]")
    ax.set_xlabel("time [s]" + describe_excerpt(law))


def trace_deviation(law: QuaternionLaw) -> tuple[Array, Array]:
    """Times [s] and the angle [rad] to the arc of the leg there, zero where it is not left."""
    times, angles = [np.zeros(1)], [np.zeros(1)]
    for segment in list_first_legs(law):
        for part in segment.list_deviations():
            u = np.linspace(0.0, 1.0, POINTS)
            times.append(segment.start_time + segment.duration * (part.start + u * (part.end - part.start)))
            angles.append(np.array([part.row.size(value**2) for value in np.abs(part.value(u)) ** 0.5]))
        times.append(np.array([segment.end_time]))
        angles.append(np.zeros(1))
    return np.concatenate(times), np.concatenate(angles)
