"""The sphere S³ of unit quaternions: vertices and edges of a lattice, and stereographic projection.

Of few orientations all of S³ is projected, from a pole where nothing is. Of many, only the half about the
first: an orientation is there once, in a ball of radius one, and what leaves it comes back opposite.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import normalise

SAME = 1e-6  # rad on S³; vertices that close are one, and edges that much longer than the shortest are edges
POINTS, MOST_POINTS = (12, 24), 6000  # of an edge, few where there are many; of all together
DIRECTIONS, ROUNDS, TRIES = 2000, 12, 60  # tried as a centre: at large, then around the best, ever nearer
MOST = 300  # orientations; the edges between more are a grey ball
WHOLE = 24  # vertices; of more only half of S³ is shown


@dataclass(frozen=True)
class Projection:
    """From the pole -c of S³ onto the space at right angles to c: p ↦ (e_i·p)/(1 + c·p)."""

    centre: Array
    basis: Array
    folded: bool = False

    def __call__(self, points: Array) -> Array:
        """Points (..., 4) of S³ as (..., 3); folded, of p and -p the one that is nearer to the centre."""
        if self.folded:
            points = np.where((points @ self.centre < 0)[..., None], -points, points)
        return np.asarray((points @ self.basis.T) / (1 + points @ self.centre)[..., None])

    def trace(self, path: Array) -> Array:
        """A path (..., m, 4) as (..., m, 3), broken by what is no number where it comes back opposite."""
        found = self(path)
        if self.folded:
            behind = path @ self.centre < 0
            found[..., 1:, :][behind[..., 1:] != behind[..., :-1]] = np.nan
        return found


def choose_projection(vertices: Array, points: Array) -> Projection:
    """For vertices (v, 4): of many the first is in the middle, of few the pole is far from the points (m, 4).

    As far as a search finds that always goes the same way.
    """
    if len(vertices) > WHOLE:
        return _complete(vertices[0], folded=True)
    rng = np.random.default_rng(0)
    tried, spread = normalise(rng.normal(size=(DIRECTIONS, 4))), 0.2
    for _ in range(ROUNDS):
        centre = tried[np.argmin(np.max(-(tried @ points.T), axis=1))]
        tried = normalise(np.vstack([centre, centre + spread * rng.normal(size=(TRIES, 4))]))
        spread /= 2
    return _complete(centre, folded=False)


def _complete(centre: Array, *, folded: bool) -> Projection:
    basis, _ = np.linalg.qr(np.column_stack([centre, np.eye(4)]))
    return Projection(centre, basis[:, 1:4].T, folded)


def list_vertices(law: QuaternionLaw) -> Array:
    """Both quaternions (2m, 4) of each orientation of the nodes, none twice; one more than `MOST` at most."""
    nodes = law(law.times)
    kept = nodes[:1]
    for node in nodes[1:]:
        if np.max(np.abs(kept @ node)) < np.cos(SAME):
            kept = np.vstack([kept, node])
        if len(kept) > MOST:
            break
    return np.concatenate([kept, -kept])


def list_edges(vertices: Array) -> NDArray[np.int64]:
    """Pairs (e, 2) of vertices (2m, 4) at the least arc that there is, opposite ones left out."""
    cosines = vertices @ vertices.T
    np.fill_diagonal(cosines, -1.0)
    arcs = np.arccos(np.clip(cosines, -1.0, 1.0))
    near = (arcs <= np.min(arcs) + SAME) & (arcs < np.pi - SAME)
    return np.argwhere(np.triu(near, 1)).astype(np.int64)


def trace_edges(vertices: Array, edges: NDArray[np.int64]) -> Array:
    """Points (e, m, 4) of the arcs from vertex to vertex."""
    start, end = vertices[edges[:, 0]], vertices[edges[:, 1]]
    count = int(np.clip(MOST_POINTS // max(len(edges), 1), *POINTS))
    u = np.linspace(0.0, 1.0, count)[None, :, None]
    return normalise((1 - u) * start[:, None] + u * end[:, None])


def lift(quaternions: Array) -> Array:
    """The same orientations (m, 4), each with the sign that is nearer to the one before."""
    signs = np.where(np.sum(quaternions[1:] * quaternions[:-1], axis=1) < 0, -1.0, 1.0)
    return quaternions * np.cumprod(np.concatenate([[1.0], signs]))[:, None]
