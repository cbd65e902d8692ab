"""The route on S³, seen stereographically, with the edges of the lattice whose vertices its nodes are."""

from typing import Any

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.report.figures.style import GRID_LINE, INK, MUTED, OMEGA
from timelaw.report.pictures.sampling import count_shown, find_last_shown, list_marks, sample_times
from timelaw.report.pictures.sketch import SIZE, WIDTH, make_panel
from timelaw.report.pictures.three_sphere import (
    MOST,
    choose_projection,
    lift,
    list_edges,
    list_vertices,
    trace_edges,
)
from timelaw.report.pictures.view import View

FINEST = 0.02  # of the picture, between two points of the route
MOST_BETWEEN = 24  # points that are put between two
MANY = 60  # legs; of more the line is thin, the nodes are small
FOOT = 0.3  # inch, for what the marks are
SHADES = 0.12, 0.5  # of edges, from the farthest to the nearest
ROUTE = OMEGA
LEAST = 1e-9  # of S³'s radius; what is smaller than that is a point
NONE = np.empty((0, 2), dtype=np.int64)


def draw_stereographic(law: QuaternionLaw) -> Any:
    """Figure: the lattice's edges grey, near ones darker, the route coloured, marks at steps of time."""
    many = len(law.legs) > MANY
    figure, ax = make_panel(WIDTH, WIDTH + FOOT)
    view, vertices = View(), list_vertices(law)
    arcs = trace_edges(vertices, list_edges(vertices) if len(vertices) <= 2 * MOST else NONE)
    step, marks = list_marks(law)
    last = find_last_shown(law)
    at_nodes = law.times[law.times <= last]
    times = np.unique(np.concatenate([sample_times(law), marks, at_nodes]))
    times = times[times <= last]
    path = lift(law(times))
    ground = np.concatenate([arcs.reshape(-1, 4)[:: 1 + arcs.size // 8000], path[:: 1 + len(path) // 2000]])
    projection = choose_projection(vertices, ground)
    times = refine(times, projection(path))
    path = lift(law(times))
    route, places = view.project(projection.trace(path)), view.project(projection(path))
    lattice = view.project(projection.trace(arcs))
    _draw_edges(ax, lattice)
    if projection.folded:
        ring = np.linspace(0.0, 2 * np.pi, 121)
        ax.plot(np.cos(ring), np.sin(ring), color=GRID_LINE, linewidth=0.8, zorder=0)
    ax.plot(*route[:, :2].T, color=ROUTE, linewidth=0.5 if many else 1.5, zorder=4)
    nodes = places[np.searchsorted(times, at_nodes)]
    ax.scatter(*nodes[:, :2].T, s=5 if many else 24, color=ROUTE, linewidths=0, zorder=5)
    if not many:
        ticks = places[np.searchsorted(times, marks)]
        ax.scatter(*ticks[:, :2].T, s=4, color=INK, linewidths=0, zorder=6)
    _frame(ax, np.concatenate([places, lattice.reshape(-1, 3)])[:, :2])
    told = f"route of {count_shown(law)}" if many else f"large dots: nodes; small dots: every {step:g} s"
    below = {"transform": ax.transAxes, "ha": "center", "va": "center"}
    ax.text(0.5, FOOT / 2 / (WIDTH + FOOT), told, fontsize=SIZE, color=MUTED, **below)
    return figure


def refine(times: Array, points: Array) -> Array:
    """The times (m,) and more between those whose points (m, 3) a straight line would join too coarsely."""
    size = float(np.max(np.ptp(points, axis=0)))
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    counts = np.clip(np.ceil(lengths / max(FINEST * size, LEAST)), 1, MOST_BETWEEN).astype(int)
    steps = zip(times[:-1], times[1:], counts, strict=True)
    return np.append(np.concatenate([np.linspace(a, b, n, endpoint=False) for a, b, n in steps]), times[-1])


def _draw_edges(ax: Any, projected: Array) -> None:
    """Edges (e, m, 3), those that are far away first and fainter."""
    from matplotlib.collections import LineCollection

    if not len(projected):
        return
    order = np.argsort(np.nanmean(projected[:, :, 2], axis=1))
    colours = [(MUTED, part) for part in np.linspace(*SHADES, len(order))]
    lines = [projected[k, :, :2] for k in order]
    ax.add_collection(LineCollection(lines, colors=colours, linewidths=0.5, zorder=1))


def _frame(ax: Any, points: Array) -> None:
    """All of the points (m, 2) and a margin, with room below for words, in true proportions."""
    low, high = np.nanmin(points, axis=0), np.nanmax(points, axis=0)
    middle, half = (low + high) / 2, max(0.54 * float(np.max(high - low)), LEAST)
    ax.set_xlim(middle[0] - half, middle[0] + half)
    ax.set_ylim(middle[1] - half * (1 + 2 * FOOT / WIDTH), middle[1] + half)


def describe_stereographic(law: QuaternionLaw) -> str:
    """What is seen, for who does not see it."""
    return (
        f"The route of {count_shown(law)} on the sphere of unit quaternions, projected stereographically "
        "into space, among the edges of the lattice of its nodes."
    )
