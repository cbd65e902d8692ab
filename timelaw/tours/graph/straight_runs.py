"""Straight ways through any set of orientations: which legs go on about the same axis in the same sense."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.turn import SAME_AXIS, allow_turn, find_turn

Leg = tuple[int, int, int]  # from, to, sense

SENSE = (1.0, 0.6180339887, 0.3183098862)  # no axis of a lattice is at right angles to it


@dataclass(frozen=True)
class Reach:
    """What lies ahead on a great circle: the steps from each node to the next, and whether they go round."""

    steps: tuple[tuple[int, int], ...]
    ring: bool


class StraightRuns:
    """For a leg i → j, the nodes k with the axis of j → k equal to its own, nearest first.

    Axes are equal where the three nodes are within `precision` [rad] of one great circle.
    A half-turn has two senses, and keeps the one it began with: sense 1 is about the axis that is more than
    a right angle from a fixed one; all other legs have sense 0. Runs go on at `passable` nodes only.
    """

    def __init__(self, quaternions: Array, passable: Collection[int], precision: float = 0.0) -> None:
        self._count, self._passable = len(quaternions), frozenset(passable)
        self._known: dict[Leg, Reach] = {}
        self._onward: dict[Leg, list[tuple[int, int]]] = {}
        for j in range(len(quaternions)) if self._passable else ():
            for i, sense, k, after in _pairs(quaternions, j, precision):
                self._onward.setdefault((i, j, sense), []).append((k, after))
        for (_, j, _), nodes in self._onward.items():
            nodes.sort(key=lambda k, j=j: -abs(float(quaternions[j] @ quaternions[k[0]])))  # type: ignore[misc]

    def __bool__(self) -> bool:
        return any(j in self._passable for _, j, _ in self._onward)

    def legs(self) -> Iterator[tuple[int, int]]:
        """All legs that can be a part of a run of more than one."""
        for (i, j, _), onward in self._onward.items():
            if j in self._passable:
                yield i, j
                yield from ((j, k) for k, _ in onward)

    def look_ahead(self, leg: Leg) -> Reach:
        """The nodes after a leg, one after the other, whether the body may pass them or not."""
        if leg[1] not in self._passable or leg not in self._onward:
            return Reach((), False)
        node, sense = self._onward[leg][0]
        first = leg[1], node, sense
        if first not in self._known:
            self._known[first] = self._follow(first)
        return self._known[first]

    def _follow(self, leg: Leg) -> Reach:
        """From a leg to the nearest node on, until it comes back to where the leg began."""
        steps, start = [leg[:2]], leg[0]
        while leg[1] != start and leg in self._onward:
            node, sense = self._onward[leg][0]
            leg = leg[1], node, sense
            steps.append(leg[:2])
        return Reach(tuple(steps), leg[1] == start)

    def runs(self) -> Iterator[tuple[int, ...]]:
        """All sequences of three and more different nodes about one axis; a whole ring ends at its start."""
        for i, j, sense in self._onward:
            waiting: list[tuple[tuple[int, ...], int]] = [((i, j), sense)]
            while waiting:
                run, last = waiting.pop()
                for node, after in self._onward.get((run[-2], run[-1], last), ()):
                    if run[-1] not in self._passable:
                        break
                    if node not in run:
                        waiting.append(((*run, node), after))
                        yield (*run, node)
                    elif node == run[0] and len(run) == self._count:
                        yield (*run, node)

    def split(self, visits: tuple[int, ...]) -> list[tuple[int, ...]]:
        """A sequence of visits as runs, each with both its ends; half-turns go on as routes have it."""
        runs, first, senses = [], 0, {0, 1}
        for at in range(1, len(visits) - 1):
            i, j, k = visits[at - 1 : at + 2]
            onward = [way for sense in senses for way in self._onward.get((i, j, sense), ())]
            senses = {after for node, after in onward if node == k}
            if not senses or j not in self._passable:
                runs.append(visits[first : at + 1])
                first = at
            senses = senses or {0, 1}
        return [*runs, visits[first:]]


def _pairs(quaternions: Array, j: int, precision: float) -> list[tuple[int, int, int, int]]:
    """(i, its sense, k, its sense) of all legs i → j and j → k that turn about one axis in one sense."""
    from scipy.spatial import cKDTree

    turns = find_turn(quaternions[j], quaternions, precision)
    nodes = np.flatnonzero(np.sin(turns.angle / 2) > max(SAME_AXIS, precision / 2))
    axes, half = turns.axis[nodes], turns.half[nodes]
    nodes, axes = np.concatenate([nodes, nodes[half]]), np.concatenate([axes, -axes[half]])
    if not len(nodes):
        return []
    half = np.concatenate([half, half[half]])
    leaving = half & (axes @ SENSE < 0)
    arriving = half & (axes @ SENSE > 0)  # i → j turns about the axis opposite to that of j → i
    angles = turns.angle[nodes]
    widest = allow_turn(angles, np.min(angles), precision)  # a short leg shows its axis least
    near_axes: Any = cKDTree(axes).query_ball_point(-axes, widest)
    first = np.repeat(np.arange(len(nodes)), [len(near) for near in near_axes])
    second = np.array([b for near in near_axes for b in near], dtype=int)
    apart = np.linalg.norm(axes[first] + axes[second], axis=1)
    straight = apart <= allow_turn(angles[first], angles[second], precision)
    kept = straight & (nodes[first] != nodes[second])
    found = {
        (int(nodes[a]), int(arriving[a]), int(nodes[b]), int(leaving[b]))
        for a, b in zip(first[kept], second[kept], strict=True)
    }
    return sorted(found)
