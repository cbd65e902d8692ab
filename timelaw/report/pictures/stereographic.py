"""The route on S³, seen stereographically, with the edges of the lattice whose vertices its nodes are."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import normalise
from timelaw.report.pictures.sampling import list_marks, sample_times
from timelaw.report.pictures.sketch import SIZE, WIDTH, make_panel
from timelaw.report.pictures.view import INK, MUTED, OMEGA, View

SAME = 1e-6  # rad on S³; vertices that close are one, and edges that much longer than the shortest are edges
POINTS, MOST_POINTS = (12, 24), 6000  # of an edge, few where there are many; of all together
DIRECTIONS, ROUNDS, TRIES = 2000, 12, 60  # tried as a centre: at large, then around the best, ever nearer
MANY = 60  # legs; of more the line is thin, the nodes are small
EDGES_FOR = 300  # nodes; the edges of more are a grey ball
FOOT = 0.3  # inch, for what the marks are
SHADES = 0.12, 0.5  # of edges, from the farthest to the nearest
ROUTE = OMEGA


@dataclass(frozen=True)
class Projection:
    """From the pole -c of S³ onto the space at right angles to c: p ↦ (e_i·p)/(1 + c·p)."""

    centre: Array
    basis: Array

    def __call__(self, points: Array) -> Array:
        """Points (..., 4) of S³ as (..., 3)."""
        return np.asarray((points @ self.basis.T) / (1 + points @ self.centre)[..., None])


def choose_projection(points: Array) -> Projection:
    """The pole as far from all of the points (m, 4) as a search finds that always goes the same way."""
    rng = np.random.default_rng(0)
    tried, spread = normalise(rng.normal(size=(DIRECTIONS, 4))), 0.2
    for _ in range(ROUNDS):
        centre = tried[np.argmin(np.max(-(tried @ points.T), axis=1))]
        tried = normalise(np.vstack([centre, centre + spread * rng.normal(size=(TRIES, 4))]))
        spread /= 2
    basis, _ = np.linalg.qr(np.column_stack([centre, np.eye(4)]))
    return Projection(centre, basis[:, 1:4].T)


def list_vertices(law: QuaternionLaw) -> Array:
    """Both quaternions (2m, 4) of each orientation among the nodes, none twice."""
    nodes = law(law.times)
    kept: list[int] = []
    for k, node in enumerate(nodes):
        if not kept or np.max(np.abs(nodes[kept] @ node)) < np.cos(SAME):
            kept.append(k)
    return np.concatenate([nodes[kept], -nodes[kept]])


def list_edges(vertices: Array) -> NDArray[np.int64]:
    """Pairs (e, 2) of vertices (2m, 4) at the least arc that there is."""
    cosines = vertices @ vertices.T
    np.fill_diagonal(cosines, -1.0)
    arcs = np.arccos(np.clip(cosines, -1.0, 1.0))
    return np.argwhere(np.triu(arcs <= np.min(arcs) + SAME, 1)).astype(np.int64)


def lift(quaternions: Array) -> Array:
    """The same orientations (m, 4), each with the sign that is nearer to the one before."""
    signs = np.where(np.sum(quaternions[1:] * quaternions[:-1], axis=1) < 0, -1.0, 1.0)
    return quaternions * np.cumprod(np.concatenate([[1.0], signs]))[:, None]


def draw_stereographic(law: QuaternionLaw) -> Any:
    """Figure: the lattice's edges grey, near ones darker, the route coloured, marks at steps of time."""
    many = len(law.legs) > MANY
    figure, ax = make_panel(WIDTH, WIDTH + FOOT)
    vertices = list_vertices(law)
    edges = list_edges(vertices) if len(vertices) <= 2 * EDGES_FOR else np.empty((0, 2), dtype=np.int64)
    arcs = _trace_edges(vertices, edges)
    step, marks = list_marks(law)
    times = np.unique(np.concatenate([sample_times(law), marks, law.times]))
    path = lift(law(times))
    ground = np.concatenate([arcs.reshape(-1, 4)[:: 1 + arcs.size // 8000], path[:: 1 + len(path) // 2000]])
    projection, view = choose_projection(ground), View()
    route = view.project(projection(path))
    lattice = view.project(projection(arcs))
    _draw_edges(ax, lattice)
    ax.plot(*route[:, :2].T, color=ROUTE, linewidth=0.5 if many else 1.5, zorder=4)
    nodes = route[np.searchsorted(times, law.times)]
    ax.scatter(*nodes[:, :2].T, s=5 if many else 24, color=ROUTE, linewidths=0, zorder=5)
    if not many:
        ticks = route[np.searchsorted(times, marks)]
        ax.scatter(*ticks[:, :2].T, s=4, color=INK, linewidths=0, zorder=6)
    _frame(ax, np.concatenate([route, lattice.reshape(-1, 3)])[:, :2])
    told = f"route of {len(law.legs)} legs" if many else f"large dots: nodes; small dots: every {step:g} s"
    below = {"transform": ax.transAxes, "ha": "center", "va": "center"}
    ax.text(0.5, FOOT / 2 / (WIDTH + FOOT), told, fontsize=SIZE, color=MUTED, **below)
    return figure


def _trace_edges(vertices: Array, edges: NDArray[np.int64]) -> Array:
    """Points (e, m, 4) of the arcs from vertex to vertex."""
    start, end = vertices[edges[:, 0]], vertices[edges[:, 1]]
    count = int(np.clip(MOST_POINTS // max(len(edges), 1), *POINTS))
    u = np.linspace(0.0, 1.0, count)[None, :, None]
    return normalise((1 - u) * start[:, None] + u * end[:, None])


def _draw_edges(ax: Any, projected: Array) -> None:
    """Edges (e, m, 3), those that are far away first and fainter."""
    from matplotlib.collections import LineCollection

    if not len(projected):
        return
    near = np.mean(projected[:, :, 2], axis=1)
    order = np.argsort(near)
    share = np.linspace(*SHADES, len(order))
    lines = LineCollection(
        [projected[k, :, :2] for k in order],
        colors=[(MUTED, part) for part in share],
        linewidths=0.5,
        zorder=1,
    )
    ax.add_collection(lines)


def _frame(ax: Any, points: Array) -> None:
    """All of the points (m, 2) and a margin, with room below for words, in true proportions."""
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    middle, half = (low + high) / 2, 0.54 * float(np.max(high - low))
    ax.set_xlim(middle[0] - half, middle[0] + half)
    ax.set_ylim(middle[1] - half * (1 + 2 * FOOT / WIDTH), middle[1] + half)


def describe_stereographic(law: QuaternionLaw) -> str:
    """What is seen, for who does not see it."""
    return (
        f"The route of {len(law.legs)} legs on the sphere of unit quaternions, projected stereographically "
        "into space, among the edges of the lattice of its nodes."
    )
