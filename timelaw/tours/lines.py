"""Which orientations lie on one great circle: where a tour along minimal legs can go straight on."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.quaternion import conjugate, multiply
from timelaw.tours.distance import NEIGHBOUR_TOLERANCE, distances

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Lines:
    """Nearest neighbours of each orientation, and the node that goes straight on from i through j.

    q_k = q_j ⊗ (q_i* ⊗ q_j), the same turn again, up to sign; absent where that is no orientation
    of the set, no neighbour, or i itself.
    """

    quaternions: Array

    @cached_property
    def neighbours(self) -> list[list[int]]:
        """Nodes at the minimal distance, of each node."""
        angles = distances(self.quaternions)
        np.fill_diagonal(angles, np.inf)
        near = angles <= np.min(angles) + NEIGHBOUR_TOLERANCE
        return [list(map(int, np.flatnonzero(row))) for row in near]

    @cached_property
    def onward(self) -> dict[tuple[int, int], int]:
        """The node straight on from i through j, where there is one."""
        q, found = self.quaternions, {}
        for i, nearest in enumerate(self.neighbours):
            turns = multiply(conjugate(q[i]), q[nearest])
            reached = multiply(q[nearest], turns)
            cosines = np.abs(reached @ q.T)
            for j, row in zip(nearest, cosines, strict=True):
                k = int(np.argmax(row))
                if row[k] > 1 - NEIGHBOUR_TOLERANCE and k != i and k in self.neighbours[j]:
                    found[i, j] = k
        return found

    def line(self, start: int, second: int) -> list[int]:
        """The nodes after `start` on the circle through `second`, once around."""
        nodes, before, here = [second], start, second
        while (onward := self.onward.get((before, here))) is not None and onward != start:
            before, here = here, onward
            nodes.append(here)
        return nodes

    def straight(self, stops: tuple[int, ...]) -> int:
        """How many inner nodes of a sequence of visits are passed straight on."""
        triples = zip(stops, stops[1:], stops[2:], strict=False)
        return sum(self.onward.get((a, b)) == c for a, b, c in triples)

    def counting_bound(self, closed: bool) -> int:
        """The most straight inner nodes that counting allows.

        A run covers at most one circle of m nodes, m - 1 legs; n legs are at least ⌈n/(m - 1)⌉ runs, and
        what joins two runs is no straight node.
        """
        count = len(self.quaternions)
        longest = max(len(self.line(i, j)) for i, nearest in enumerate(self.neighbours) for j in nearest)
        legs = count - 1 + closed
        runs = -(-legs // longest)
        return legs - runs
