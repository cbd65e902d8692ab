"""How a motion through the nodes bends the arcs: traces of the body axes, and the way it keeps from them."""

from typing import Any

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import rotation_matrix
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.overview import fill_steps
from timelaw.report.figures.sphere import AXES, draw_globe
from timelaw.report.figures.style import (
    DASHED,
    LIMIT,
    NODE,
    OPTIMISED,
    QUINTIC,
    SIZE,
    Canvas,
    set_ticks,
    stack_panels,
    write_title,
)
from timelaw.report.figures.time_scale import TimeScale
from timelaw.report.figures.window import is_long

POINTS = 40  # of each leg
HEIGHT = 1.3  # inch


def draw_passing(scene: Scene, canvas: Canvas) -> Any:
    """The angle to the arcs over time, and of a short motion the traces of both on the sphere."""
    law = scene.law
    globes = 0.0 if is_long(law) else canvas.width / 3
    figure, (ax,) = stack_panels(canvas, [HEIGHT], top=0.1 + globes + (0.2 if globes else 0.0))
    _draw_deviation(ax, scene, canvas)
    if globes:
        _draw_globes(figure, scene, globes)
    return figure


def _draw_globes(figure: Any, scene: Scene, size: float) -> None:
    """Three globes of a size [inch] beside each other, a body axis on each."""
    law, route = scene.law, scene.design.route
    legs, (width, height) = len(law.legs), figure.get_size_inches()
    arcs = rotation_matrix(route.orientation(np.linspace(0, legs, legs * POINTS + 1)))
    nodes = rotation_matrix(route.orientation(np.arange(legs + 1.0)))
    path = law.rotation(np.linspace(0.0, law.duration, legs * POINTS + 1))
    for index, (axis, colour) in enumerate(AXES):
        box = (index * size / width, 1 - (size + 0.2) / height, size / width, size / height)
        ax: Any = figure.add_axes(box, projection="3d")
        draw_globe(ax)
        ax.plot(*arcs[:, :, index].T, color=QUINTIC, linewidth=0.8, linestyle=DASHED)
        ax.plot(*path[:, :, index].T, color=colour, linewidth=1.3)
        ax.scatter(*nodes[:, :, index].T, color=colour, s=10, depthshade=False)
        figure.text(
            (index + 0.5) * size / width, 1 - 0.16 / height, f"body axis {axis}", ha="center", fontsize=SIZE
        )


def _draw_deviation(ax: Any, scene: Scene, canvas: Canvas) -> None:
    """Over time; of a long motion the largest on each leg."""
    law = scene.law
    scale = TimeScale(law.segments)
    if is_long(law):
        largest = np.degrees(scene.deviations)
        fill_steps(ax, scale(scale.times), np.zeros(len(largest)), largest, OPTIMISED, 0.75)
    else:
        parts = [trace_deviation(law, k) for k in range(len(law.segments))]
        times, angles = (np.concatenate(part) for part in zip(*parts, strict=True))
        ax.plot(scale(times), np.degrees(angles), color=OPTIMISED, linewidth=1.3)
        for time in law.times:
            ax.axvline(scale(time), color=NODE, linewidth=0.7, zorder=0)
    bound = scene.design.problem.motion.deviation
    if bound is not None:
        ax.axhline(np.degrees(bound), color=LIMIT, linewidth=1, linestyle=DASHED)
    ax.set_ylim(bottom=0)
    ax.set_xlim(0, scale.end)
    set_ticks(ax)
    write_title(ax, ["angle to the arc, deg"], "" if bound is None else f"bound {np.degrees(bound):g}")
    scale.mark(ax, canvas, scale.end)
    ax.set_xlabel("time, s", fontsize=SIZE)


def trace_deviation(law: QuaternionLaw, index: int) -> tuple[Array, Array]:
    """Times [s] and the angle [rad] to its arc on one segment, zero where that is not left."""
    segment = law.segments[index]
    times, angles = [np.array([segment.start_time])], [np.zeros(1)]
    for part in segment.list_deviations():
        u = np.linspace(0.0, 1.0, POINTS)
        times.append(segment.start_time + segment.duration * (part.start + u * (part.end - part.start)))
        angles.append(np.array([part.row.size(value**2) for value in np.abs(part.value(u)) ** 0.5]))
    times.append(np.array([segment.end_time]))
    angles.append(np.zeros(1))
    return np.concatenate(times), np.concatenate(angles)
