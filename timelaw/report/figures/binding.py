"""Where the limits bind: for each limit a strip of the motion, full where a segment uses it up."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from timelaw.certificate import Certificate
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.report.active_limits import ACTIVE
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.style import (
    BINDING,
    DWELL,
    NODE,
    OTHER,
    SIZE,
    Canvas,
    set_ticks,
    stack_panels,
    write_title,
)
from timelaw.report.figures.time_scale import TimeScale

HEIGHT = 0.15  # inch, of a strip
LEVELS = (0.0, 0.25, 0.5, 0.75, 0.9, ACTIVE)  # parts of a limit, from which a shade holds
SHADES = (0.06, 0.13, 0.22, 0.33, 0.5, 1.0)


def draw_binding(scene: Scene, canvas: Canvas) -> Any:
    """A strip for each limit, coloured by the part of it that each segment uses, as it was proved."""
    law = scene.law
    used = measure_use(law, scene.optimised.certificate)
    scale = TimeScale(law.segments)
    figure, axes = stack_panels(canvas, [HEIGHT] * len(used))
    edges = scale(scale.times)
    moving = np.array([segment.moves for segment in law.segments])
    for (label, parts), ax in zip(used.items(), axes, strict=True):
        colour = BINDING.get(label.split(" ")[0], OTHER)
        steps = np.searchsorted(LEVELS, parts, side="right") - 1
        steps[~moving] = -1
        fill_stretches(ax, edges, steps == -1, DWELL, 1.0)
        for step, shade in enumerate(SHADES):
            fill_stretches(ax, edges, steps == step, colour, shade)
        binding = int(np.count_nonzero(parts >= ACTIVE))
        what = label.replace("_", " ")
        write_title(ax, [what], f"binds on {binding} of {len(law.legs)} legs")
        ax.set_xlim(0, scale.end)
        ax.set_ylim(0, 1)
        ax.set_xticks([])
        ax.set_yticks([])
        ax.spines["left"].set_visible(False)
        if len(law.segments) * 8 < canvas.width * 72:
            ax.vlines(edges, 0, 1, color=NODE, linewidth=0.6)
    scale.mark(axes[-1], canvas, scale.end)
    set_ticks(axes[-1])
    axes[-1].set_xlabel("time, s", fontsize=SIZE)
    return figure


def measure_use(law: QuaternionLaw, certificate: Certificate) -> dict[str, Array]:
    """By limit, one of a single segment counted with its kind, the part that each segment uses at most."""
    used: dict[str, Array] = {}
    for peak in certificate.peaks:
        parts = used.setdefault(peak.label.split(" on ")[0], np.zeros(len(law.segments)))
        parts[peak.index] = max(parts[peak.index], peak.used)
    return {label: parts for label, parts in used.items() if np.any(parts)}


def fill_stretches(ax: Any, edges: Array, chosen: NDArray[np.bool_], colour: str, alpha: float) -> None:
    """The segments that are chosen, neighbours together, as one path."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    corners: list[Sequence[tuple[float, float]]] = []
    steps = np.diff(np.concatenate([[0], chosen.astype(int), [0]]))
    for first, last in zip(np.flatnonzero(steps == 1), np.flatnonzero(steps == -1), strict=True):
        a, b = float(edges[first]), float(edges[last])
        corners.append([(a, 0), (a, 1), (b, 1), (b, 0), (a, 0)])
    if corners:
        codes = [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY] * len(corners)
        path = Path([corner for five in corners for corner in five], codes)
        ax.add_artist(PathPatch(path, facecolor=colour, alpha=alpha, linewidth=0))
