"""Which orientations lie on one great circle: where a tour along minimal legs can go straight on."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import ceil

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between, conjugate, multiply
from timelaw.numerics.turn import allow_turn, angle_between_axes, find_turn
from timelaw.tours.graph.distances import list_neighbours


@dataclass(frozen=True)
class MinimalLegs:
    """Nearest neighbours of each orientation, and the node that goes straight on from i through j.

    q_k = q_j ⊗ (q_i* ⊗ q_j), the same turn again, up to sign; absent where that is no orientation
    of the set, no neighbour, or i itself. All within the `precision` [rad] of the orientations.
    """

    quaternions: Array
    precision: float = 0.0

    def __len__(self) -> int:
        return len(self.quaternions)

    @cached_property
    def neighbours(self) -> list[list[int]]:
        """Nodes at the minimal distance, of each node."""
        return list_neighbours(self.quaternions, self.precision)

    @cached_property
    def axes(self) -> dict[tuple[int, int], Array]:
        """Unit axis (3,) of the leg from i to each of its neighbours, in body axes."""
        found: dict[tuple[int, int], Array] = {}
        for i, nearest in enumerate(self.neighbours):
            axes = find_turn(self.quaternions[i], self.quaternions[nearest]).axis
            found |= {(i, j): axis for j, axis in zip(nearest, axes, strict=True)}
        return found

    @cached_property
    def onward(self) -> dict[tuple[int, int], int]:
        """The node straight on from i through j, where there is one."""
        q, found = self.quaternions, {}
        for i, nearest in enumerate(self.neighbours):
            turns = multiply(conjugate(q[i]), q[nearest])
            reached = multiply(q[nearest], turns)
            for j, row in zip(nearest, np.abs(reached @ q.T), strict=True):
                k = int(np.argmax(row))
                if k != i and k in self.neighbours[j] and self._is_straight(i, j, k):
                    found[i, j] = k
        return found

    def turn(self, i: int, j: int, k: int) -> float:
        """Angle [rad] by which the axis turns at j, between the legs from i and to k; 0 straight on."""
        return 0.0 if self.onward.get((i, j)) == k else self._turn(i, j, k)

    def _is_straight(self, i: int, j: int, k: int) -> bool:
        q = self.quaternions
        most = allow_turn(angle_between(q[i], q[j]), angle_between(q[j], q[k]), self.precision)
        return self._turn(i, j, k) <= float(most)

    def _turn(self, i: int, j: int, k: int) -> float:
        return angle_between_axes(self.axes[i, j], self.axes[j, k])

    @cached_property
    def least_turn(self) -> float:
        """The least turn [rad] of the axis at any node, straight on apart; 0 if there is none."""
        turns = (
            self.turn(i, j, k) for j, near in enumerate(self.neighbours) for i in near for k in near if i != k
        )
        return min((turn for turn in turns if turn > 0), default=0.0)

    def line(self, start: int, second: int) -> list[int]:
        """The nodes after `start` on the circle through `second`, once around."""
        nodes, before, here = [second], start, second
        while (onward := self.onward.get((before, here))) is not None and onward != start:
            before, here = here, onward
            nodes.append(here)
        return nodes

    @cached_property
    def reach(self) -> list[int]:
        """Legs of the longest run through each node; a circle of m orientations allows m - 1."""
        longest = [0] * len(self)
        for i, nearest in enumerate(self.neighbours):
            for j in nearest:
                nodes = self.line(i, j)
                for node in (i, *nodes):
                    longest[node] = max(longest[node], len(nodes))
        return longest

    @cached_property
    def longest(self) -> int:
        """Legs of the longest run."""
        return max(self.reach)

    def straight(self, visits: Sequence[int]) -> int:
        """How many inner nodes of a sequence of visits are passed straight on."""
        triples = zip(visits, visits[1:], visits[2:], strict=False)
        return sum(self.onward.get((a, b)) == c for a, b, c in triples)

    def turning(self, visits: Sequence[int]) -> float:
        """Sum of the turns [rad] of the axis at the inner nodes of a sequence of visits."""
        triples = zip(visits, visits[1:], visits[2:], strict=False)
        return sum(self.turn(a, b, c) for a, b, c in triples)

    def counting_bound(self, closed: bool) -> int:
        """The most straight inner nodes that counting allows.

        A run of l legs arrives at l nodes, through each of which goes a run of l legs or more; so the sum of
        1/(longest run) over all nodes that are arrived at is no more than the number of runs, and what
        joins two runs is no straight node.
        """
        if closed and self._is_ring():
            return len(self) - 1
        shares = [Fraction(1, legs) for legs in self.reach]
        runs = ceil(sum(shares) - (0 if closed else max(shares)))
        return len(self) - 1 + closed - runs

    def _is_ring(self) -> bool:
        """Whether one circle goes through all nodes: a closed tour rounds it in one run."""
        rounds = ((i, *self.line(i, j)) for i in range(len(self)) for j in self.neighbours[i])
        whole = next((nodes for nodes in rounds if len(nodes) == len(self) > 2), None)
        return whole is not None and self.onward.get((whole[-2], whole[-1])) == whole[0]
