"""How short a tour can be at best: Held & Karp's bound by trees, raised by prices on the nodes (1970, 1971).

Take any prices π on the nodes and let a leg cost c_ij + π_i + π_j. An open tour is a tree in which
all nodes have two legs, but the first and last one; so it costs at least
    least tree + π_first + π_last - 2 Σπ,
with the two cheapest nodes for ends that are free. A closed tour is a tree on all nodes but one, and
two legs of that one. Every choice of prices gives a bound; nodes with too many legs in the tree are
made dearer, those with too few cheaper, and the best bound counts. Prices are raised by trees of likely
legs; the bound that they give is one over all legs.
"""

import numpy as np

from timelaw.numerics.array import Array
from timelaw.progress import Progress, tell
from timelaw.tours.ends import Ends
from timelaw.tours.search.costs import Costs, Indices
from timelaw.tours.search.spanning_tree import LikelyLegs, grow_tree

STEPS = 250
PATIENCE = 12  # steps without a better bound before they get smaller
ROUNDING = 1e-12  # of the sum of all that is added up, per node
MOMENTUM = 0.6  # of the last direction that goes into the next
ROUNDS = 4  # of bounds over all legs, each with the likely ones that the last one missed
MISSED = 0.01  # of the gap, by which the bound over all legs may be below the one over likely ones


class TreeBound:
    """The bound, and the prices (N,) by which it is found; they also tell which legs short tours have."""

    def __init__(self, costs: Costs, ends: Ends) -> None:
        self._costs, self._ends = costs, ends
        self._root = int(ends.closed)  # of the tree: a closed tour's stands without node 0
        self.prices = np.zeros(len(costs))
        tree = grow_tree(costs, self.prices, self._root)
        self._likely = LikelyLegs(costs, tree, self._root)
        self.value = self._relax(tree, self.prices)[0]

    def find(self, reached: float, progress: Progress | None = None) -> float:
        """A number that no tour's cost is below; `reached` sets the size of the steps."""
        for _ in range(ROUNDS):
            likely = self.ascend(reached, progress)
            tree = grow_tree(self._costs, self.prices, self._root)
            self.value = max(self.value, self._relax(tree, self.prices)[0])
            if likely - self.value <= MISSED * (reached - likely):
                break
            self._likely.add(tree)
        largest = self._costs.largest + float(np.max(np.abs(self.prices)))
        slack = ROUNDING * len(self._costs) ** 2 * largest
        return min(self.value - slack, reached)

    def ascend(self, reached: float, progress: Progress | None = None) -> float:
        """Raise the prices by trees of likely legs; the value of these, which is no bound yet."""
        prices, best, since = self.prices, -np.inf, 0
        scale, direction = 1.0, np.zeros(len(prices))
        for step in range(STEPS):
            value, degrees = self._relax(self._likely.find_tree(prices), prices)
            since += 1
            if value > best:
                best, self.prices, since = value, prices, 0
            excess = degrees - 2.0
            if not np.any(excess) or reached - best <= ROUNDING * len(prices) * abs(reached):
                break  # the tree is a tour, or as dear as one
            if since >= PATIENCE:
                scale, since, prices, direction = scale / 2, 0, self.prices, np.zeros(len(prices))
            direction = excess + MOMENTUM * direction
            prices = prices + scale * max(reached - value, 0.0) / float(excess @ excess) * direction
            tell(progress, "lower bound", step, STEPS)
        return best

    def _relax(self, tree: Indices, prices: Array) -> tuple[float, Array]:
        """The bound that the least tree for these prices gives, and how many legs each node then has."""
        degrees = np.bincount(tree.ravel(), minlength=len(prices)).astype(float)
        value = float(np.sum(self._costs.legs(tree[:, 0], tree[:, 1]))) + float(degrees @ prices)
        if self._ends.closed:
            legs = self._costs.row(0)[1:] + prices[1:] + prices[0]
            two = np.argsort(legs, kind="stable")[:2]
            degrees[[0, 0, *(1 + two)]] = [2, 2, *(degrees[1 + two] + 1)]
            return value + float(np.sum(legs[two])) - 2 * float(np.sum(prices)), degrees
        given = [node for node in (self._ends.start, self._ends.end) if node is not None]
        others = [int(node) for node in np.argsort(prices, kind="stable")[:3] if node not in given]
        tips = [*given, *others][:2]
        degrees[tips] += 1
        return value + float(np.sum(prices[tips])) - 2 * float(np.sum(prices)), degrees
