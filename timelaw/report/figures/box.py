"""The body as a box at instants along its motion, with the paths of its corners, as [HZ2019] draws it."""

from itertools import product
from typing import Any

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.style import MUTED, SIZE, Canvas

INSTANTS = 15
POINTS = 600  # of each corner's path
VIEW = {"elev": 24.0, "azim": -58.0}
MARGIN = 0.04  # of the longest side of what is drawn
FACES = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]
FACE, EDGE, PATH, WAY = "#0b5fa5", "#0b3d66", "#b07400", "#b3261e"


def draw_box(scene: Scene, canvas: Canvas) -> Any:
    """The box of the law's shape at 15 instants, first to last, and where its corners go."""
    from matplotlib.figure import Figure
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    law = scene.law
    times = np.linspace(0.0, law.duration, INSTANTS)
    paths = trace_corners(law, np.linspace(0.0, law.duration, POINTS))
    figure = Figure(figsize=(canvas.width, canvas.width * (0.72 if canvas.wide else 1.05)))
    ax: Any = figure.add_axes((0.02, 0.02, 0.96, 0.92), projection="3d")
    for corner in range(8):
        label = "paths of the corners" if corner == 0 else None
        ax.plot(*paths[:, corner].T, color=PATH, linewidth=0.6, alpha=0.8, label=label)
    if law.travels:
        way = law.place(np.linspace(0.0, law.duration, POINTS))
        ax.plot(*way.T, color=WAY, linewidth=0.9, linestyle=(0, (4, 2)), label="path of the origin")
    for index, corners in enumerate(trace_corners(law, times)):
        shade = 0.12 + 0.5 * index / (INSTANTS - 1)  # later ones are darker
        faces = [corners[face] for face in FACES]
        box = Poly3DCollection(faces, facecolors=FACE, edgecolors=EDGE, linewidths=0.5)
        box.set_alpha(shade)
        ax.add_collection3d(box)
    _frame(ax, paths, canvas)
    figure.legend(loc="upper left", fontsize=SIZE, ncols=2)
    return figure


def trace_corners(law: QuaternionLaw, times: Array) -> Array:
    """The corners (m, 8, 3) of the box in the world; z changes fastest, then y, then x."""
    corners = np.array(list(product((-0.5, 0.5), repeat=3))) * np.array(law.shape)
    turned = np.einsum("mij,kj->mki", law.rotation(times), corners)
    return np.asarray(turned + law.place(times)[:, None] if law.travels else turned)


def _frame(ax: Any, paths: Array, canvas: Canvas) -> None:
    """Axes of one scale around all corners."""
    from matplotlib.ticker import MaxNLocator

    low, high = np.min(paths, axis=(0, 1)), np.max(paths, axis=(0, 1))
    margin = MARGIN * float(np.max(high - low))
    for name, a, b in zip("xyz", low - margin, high + margin, strict=True):
        getattr(ax, f"set_{name}lim")(a, b)
        getattr(ax, f"set_{name}label")(f"{name} [m]", fontsize=SIZE)
        axis = getattr(ax, f"{name}axis")
        axis.set_major_locator(MaxNLocator(6 if canvas.wide else 4))
        axis.set_pane_color((0.5, 0.5, 0.5, 0.06))
        axis.line.set_color(MUTED)
    ax.tick_params(labelsize=SIZE, pad=0 if canvas.wide else -2)
    ax.set_box_aspect(high - low + 2 * margin, zoom=1.0 if canvas.wide else 0.86)
    ax.view_init(**VIEW)
