"""A window of a tour: some nodes, to be visited in another order while all that lies between them stays.

Where the tour leaves the window and comes back, the way outside is a fixed leg between two nodes of it,
one that no exchange can afford to take out; nodes alone between two such ways belong to them. So a window's
tour costs less exactly if the whole does, and what it takes does not depend on the size of the whole.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from timelaw.numerics.array import Array
from timelaw.tours.search.costs import CostMatrix, Costs, Indices
from timelaw.tours.search.lin_kernighan import Cycle, Near

SIZE, CORE = 500, 300  # nodes of a window; those in the middle, which no later window need have in its own
FIXED = 1e6  # times the dearest leg: what is saved by keeping a fixed one


class Window:
    """The part of a tour `nodes` that visits the `members`, as a `cycle` of its own."""

    def __init__(
        self, costs: Costs, prices: Array, near: Near, nodes: Sequence[int], members: Indices
    ) -> None:
        inside = np.zeros(len(nodes), dtype=bool)
        inside[members] = True
        tour = np.array(nodes)
        here = inside[tour]
        inside[tour[here & ~np.roll(here, 1) & ~np.roll(here, -1)]] = False  # alone between two ways outside
        places = np.flatnonzero(inside[tour])
        tour = np.roll(tour, -int(places[0])) if len(places) else tour
        self.members = tour[inside[tour]]
        self._ways = dict(_list_ways(tour.tolist(), inside.tolist()))
        own = {int(node): k for k, node in enumerate(self.members)}
        count = len(own)
        legs = costs.legs(np.repeat(self.members, count), np.tile(self.members, count)).reshape(count, count)
        legs += prices[self.members][:, None] + prices[self.members]
        fixed = [(own[i], own[j]) for i, j in self._ways]
        most = FIXED * float(np.max(np.abs(legs), initial=0.0))
        for i, j in fixed:
            legs[i, j] = legs[j, i] = -most
        partner = dict(fixed) | {j: i for i, j in fixed}
        tried = [
            [(own[j], leg) for j, leg in near[int(node)] if j in own and own[j] != partner.get(k)]
            for k, node in enumerate(self.members)
        ]
        self.cycle = Cycle(range(count), CostMatrix(legs).price(np.zeros(count)), tried, most / 2)

    def __len__(self) -> int:
        return len(self.members)

    def join(self) -> list[int]:
        """The whole tour, with the window as its cycle is now."""
        nodes: list[int] = []
        visits = [int(self.members[k]) for k in self.cycle.nodes]
        for i, j in pairwise([*visits, visits[0]]):
            nodes.append(i)
            nodes += self._ways.get((i, j), ()) or reversed(self._ways.get((j, i), ()))
        return nodes


def list_windows(costs: Costs) -> Iterator[Indices]:
    """Members of windows that cover all nodes: those around the first node that is in the middle of none."""
    left = np.ones(len(costs), dtype=bool)
    while np.any(left):
        centre = int(np.argmax(left))
        row = costs.row(centre).copy()
        row[centre] = -np.inf
        nearest = np.argsort(row, kind="stable")[:SIZE]
        left[nearest[:CORE]] = False
        yield nearest


def _list_ways(tour: list[int], inside: list[bool]) -> Iterator[tuple[tuple[int, int], tuple[int, ...]]]:
    """The ways outside of a window, by the nodes where they begin and end; the tour begins inside of it."""
    way: list[int] = []
    before = tour[0]
    for node in [*tour[1:], tour[0]]:
        if not inside[node]:
            way.append(node)
            continue
        if way:
            yield (before, node), tuple(way)
        before, way = node, []
