"""Great circles of chains that share nodes, fitted together: each shared node is on both of its circles."""

from collections import Counter
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import multiply
from timelaw.route.chains import Chain
from timelaw.route.great_circle import GreatCircle

STEPS = 25  # of Gauss and Newton; from a fit within the precision four or five are enough
ENOUGH = 1e-13  # a step below it leaves the next one, its square, below all rounding
SOFT = 1e-13  # lets a condition that says nothing new do so; what it gives way is taken back by the next step
UNITS = np.eye(4)[1:]

Places = NDArray[np.intp]


class JointFit:
    """The least squares of the moves that bring visits (n, 4) onto circles, exactly, by Gauss–Newton.

    A circle has four freedoms, two tilts of u and two of v towards its normals; a shared node has three.
    An inner node goes to the nearest place of its circle; a shared one has to be on each of its circles.
    """

    def __init__(self, points: Array, members: Sequence[Chain], *, closed: bool) -> None:
        self._points, self._members = points, members
        self._last = len(points) - 1 if closed else -1
        counts = Counter(self._node(end) for m in members for end in (m.first, m.last))
        self._shared = sorted(node for node, count in counts.items() if count > 1)
        self._own = [
            np.array([i for i in range(m.first, m.last + 1) if self._node(i) not in self._shared], dtype=int)
            for m in members
        ]
        self._joints = [
            (k, self._shared.index(self._node(end)))
            for k, m in enumerate(members)
            for end in (m.first, m.last)
            if self._node(end) in self._shared
        ]

    def _node(self, visit: int) -> int:
        """The visit that stands for a node: the first one for the last of a closed tour."""
        return 0 if visit == self._last else visit

    def solve(
        self, circles: Sequence[GreatCircle], weights: Array, *, free: bool
    ) -> tuple[list[GreatCircle], Array]:
        """Circles and the visits (n, 4) on them, from circles near by.

        `weights` (n,) multiply the squares of the moves; shared nodes stay where they are unless `free`.
        """
        circles = [self._centred(k, circle) for k, circle in enumerate(circles)]
        nodes = self._points[self._shared]
        for _ in range(STEPS):
            changes, turns = self._step(circles, nodes, weights, free=free)
            circles = [_move(circle, change) for circle, change in zip(circles, changes, strict=True)]
            nodes = nodes + multiply(nodes, np.column_stack([np.zeros(len(nodes)), turns]))
            nodes /= np.linalg.norm(nodes, axis=1, keepdims=True)
            if max(np.max(np.abs(changes)), np.max(np.abs(turns), initial=0.0)) < ENOUGH:
                break
        return circles, self._place(circles, nodes)

    def _centred(self, k: int, circle: GreatCircle) -> GreatCircle:
        """A circle begun in the middle of its chain, where tilts of u and of v differ most."""
        places = circle.places(self._points[self._members[k].visits])
        length = float(np.sum(np.mod(np.diff(places), np.pi)))
        return circle.begun_at(float(places[0]) + length / 2)

    def _place(self, circles: Sequence[GreatCircle], nodes: Array) -> Array:
        visits = np.array(self._points)
        for circle, own in zip(circles, self._own, strict=True):
            visits[own] = circle.nearest(self._points[own])
        visits[self._shared] = nodes
        if self._last >= 0 and 0 in self._shared:
            visits[self._last] = visits[0]
        return visits

    def _step(
        self, circles: Sequence[GreatCircle], nodes: Array, weights: Array, *, free: bool
    ) -> tuple[Array, Array]:
        """Changes of u and v (chains, 2, 4), and turns (shared, 3) of the nodes, of the next step.

        The normal coordinate of the place t is a cos t + b sin t with tilts a, b; for each of two normals
        the least squares of it against that of the visit, under what the joints ask for.
        """
        system = _System(4 * len(circles) + (3 * len(nodes) if free else 0))
        normals = [circle.normals for circle in circles]
        spread = [self._spread(k, circle) for k, circle in enumerate(circles)]
        for k, (circle, own) in enumerate(zip(circles, self._own, strict=True)):
            points, w = self._points[own], weights[own]
            basis = _basis(circle.places(points), spread[k])
            weighted = (basis * w[:, None]).T
            for side in (0, 1):
                at = 4 * k + 2 * side + np.arange(2)
                system.add(at, weighted @ basis, weighted @ (points @ normals[k][:, side]))
        tangents = multiply(nodes[:, None, :], UNITS)
        for k in range(len(nodes) if free else 0):
            visit = self._points[self._shared[k]]
            w = weights[self._shared[k]]
            at = 4 * len(circles) + 3 * k + np.arange(3)
            system.add(at, w * np.eye(3), w * tangents[k] @ visit)
        for k, node in self._joints:
            row = _basis(circles[k].places(nodes[node : node + 1]), spread[k])[0]
            for side in (0, 1):
                normal = normals[k][:, side]
                at, values = 4 * k + 2 * side + np.arange(2), -row
                if free:
                    at = np.concatenate([at, 4 * len(circles) + 3 * node + np.arange(3)])
                    values = np.concatenate([values, tangents[node] @ normal])
                system.ask(at, values, -float(normal @ nodes[node]))
        found = system.solve()
        tilts = found[: 4 * len(circles)].reshape(-1, 2, 2)
        changes = np.array([(normals[k] @ tilt).T for k, tilt in enumerate(tilts)])
        changes[:, 1] /= np.array(spread)[:, None]
        turns = found[4 * len(circles) :].reshape(-1, 3) if free else np.zeros((len(nodes), 3))
        return changes, turns

    def _spread(self, k: int, circle: GreatCircle) -> float:
        """The largest |sin t| of a chain's visits: tilts of v are counted in what they do there."""
        places = circle.places(self._points[self._members[k].visits])
        return float(np.max(np.abs(np.sin(places))))


class _System:
    """A least squares problem under linear conditions, put together from small blocks."""

    def __init__(self, size: int) -> None:
        self._size = size
        self._gram: list[tuple[Places, Places, Array]] = []
        self._conditions: list[tuple[Places, Array]] = []
        self._right, self._asked = np.zeros(size), list[float]()

    def add(self, at: Places, gram: Array, right: Array) -> None:
        """Add xᵀGx/2 - rᵀx in the unknowns `at` (m,)."""
        rows, columns = np.meshgrid(at, at, indexing="ij")
        self._gram.append((rows.ravel(), columns.ravel(), gram.ravel()))
        self._right[at] += right

    def ask(self, at: Places, values: Array, right: float) -> None:
        """Ask for values · x = right, in the unknowns `at` (m,)."""
        self._conditions.append((at, values))
        self._asked.append(right)

    def solve(self) -> Array:
        """The unknowns (size,)."""
        from scipy.sparse import coo_array
        from scipy.sparse.linalg import splu

        whole = self._size + len(self._conditions)
        diagonal = np.arange(whole)
        soft = np.where(diagonal < self._size, SOFT, -SOFT)
        rows: list[Places] = [diagonal]
        columns: list[Places] = [diagonal]
        values: list[Array] = [soft]
        for r, c, v in self._gram:
            rows += [r]
            columns += [c]
            values += [v]
        for k, (at, v) in enumerate(self._conditions):
            row = np.full(len(at), self._size + k)
            rows += [row, at]
            columns += [at, row]
            values += [v, v]
        place = (np.concatenate(rows), np.concatenate(columns))
        matrix = coo_array((np.concatenate(values), place), shape=(whole, whole)).tocsc()
        return np.asarray(splu(matrix).solve(np.concatenate([self._right, self._asked])))[: self._size]


def _basis(places: Array, spread: float) -> Array:
    """Columns cos t and sin t / spread, (n, 2)."""
    return np.column_stack([np.cos(places), np.sin(places) / spread])


def _move(circle: GreatCircle, change: Array) -> GreatCircle:
    """The circle with u and v changed, orthonormal again."""
    u = circle.u + change[0]
    u = u / np.linalg.norm(u)
    v = circle.v + change[1]
    v = v - (v @ u) * u
    return GreatCircle(u, v / np.linalg.norm(v))
