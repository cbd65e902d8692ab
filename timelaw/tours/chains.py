"""Straight ways through any set of orientations: which legs go on about the same axis in the same sense."""

from collections.abc import Collection, Iterator

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.quaternion import conjugate, multiply

Array = NDArray[np.float64]

SAME_AXIS = 1e-7  # rad, as for routes: quaternions typed with seven digits still go straight
HALF_TURN = 1e-9  # |q_i·q_j| below which a leg may turn either way round


class Chains:
    """For a leg i → j, the nodes k with the axis of j → k equal to its own, nearest first.

    Only at nodes that the body may pass; half-turns have both senses.
    """

    def __init__(self, quaternions: Array, passable: Collection[int]) -> None:
        self._onward: dict[tuple[int, int], list[int]] = {}
        for j in sorted(passable):
            for i, k in _pairs(quaternions, j):
                self._onward.setdefault((i, j), []).append(k)
        for (_, j), nodes in self._onward.items():
            nodes.sort(key=lambda k, j=j: -abs(float(quaternions[j] @ quaternions[k])))  # type: ignore[misc]

    def __bool__(self) -> bool:
        return bool(self._onward)

    def goes_on(self, i: int, j: int, k: int) -> bool:
        """Whether the body need not stop at j between i and k."""
        return k in self._onward.get((i, j), ())

    def legs(self) -> Iterator[tuple[int, int]]:
        """All legs that can be a part of a run of more than one."""
        for (i, j), onward in self._onward.items():
            yield i, j
            yield from ((j, k) for k in onward)

    def runs(self) -> Iterator[tuple[int, ...]]:
        """All sequences of at least three different nodes about one axis."""
        for leg in self._onward:
            waiting: list[tuple[int, ...]] = [leg]
            while waiting:
                run = waiting.pop()
                for node in self._onward.get((run[-2], run[-1]), ()):
                    if node not in run:
                        waiting.append((*run, node))
                        yield (*run, node)

    def split(self, stops: tuple[int, ...]) -> list[tuple[int, ...]]:
        """A sequence of visits as runs, each with both its ends."""
        runs, first = [], 0
        for at in range(1, len(stops) - 1):
            if not self.goes_on(*stops[at - 1 : at + 2]):
                runs.append(stops[first : at + 1])
                first = at
        return [*runs, stops[first:]]


def _pairs(quaternions: Array, j: int) -> list[tuple[int, int]]:
    """Pairs (i, k) such that i → j and j → k turn about one axis in one sense."""
    from scipy.spatial import cKDTree

    turns = multiply(conjugate(quaternions[j]), quaternions)
    turns = turns * np.where(turns[:, :1] < 0, -1.0, 1.0)
    nodes = np.flatnonzero(np.linalg.norm(turns[:, 1:], axis=1) > SAME_AXIS)
    axes = turns[nodes, 1:] / np.linalg.norm(turns[nodes, 1:], axis=1, keepdims=True)
    both = np.abs(turns[nodes, 0]) <= HALF_TURN
    nodes, axes = np.concatenate([nodes, nodes[both]]), np.concatenate([axes, -axes[both]])
    if not len(nodes):
        return []
    found = {
        (int(nodes[a]), int(nodes[b]))
        for a, near in enumerate(cKDTree(axes).query_ball_point(-axes, SAME_AXIS))
        for b in near
        if nodes[a] != nodes[b]
    }
    return sorted(found)
