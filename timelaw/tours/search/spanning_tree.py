"""Least spanning trees: over all legs, row by row, and over the few that are likely to be in one."""

import numpy as np

from timelaw.numerics.array import Array
from timelaw.tours.search.costs import Costs, Indices

LIKELY = 10  # nearest nodes


def grow_tree(costs: Costs, prices: Array, root: int = 0) -> Indices:
    """Edges (N - 1 - root, 2) of the least tree on the nodes from `root` on, by Prim's rule.

    A leg costs its own cost and the prices (N,) of its ends. All are compared; time grows as N², memory as N.
    """
    count = len(costs)
    outside, parent = np.full(count, np.inf), np.zeros(count, dtype=np.intp)
    left = np.arange(count) >= root
    edges, node = np.empty((count - 1 - root, 2), dtype=np.intp), root
    for edge in edges:
        left[node], outside[node] = False, np.inf
        row = costs.row(node) + prices
        row += prices[node]
        nearer = (row < outside) & left
        outside[nearer] = row[nearer]
        parent[nearer] = node
        node = int(np.argmin(outside))
        edge[:] = parent[node], node
    return edges


class LikelyLegs:
    """Legs to the nearest nodes and those of some trees, among which the least tree is found quickly."""

    def __init__(self, costs: Costs, tree: Indices, root: int = 0) -> None:
        self._costs, self._root = costs, root
        count = len(costs)
        near = costs.nearest(min(LIKELY, count - 1))
        self._keys = np.empty(0, dtype=np.intp)
        self.add(np.stack([np.repeat(np.arange(count), near.shape[1]), near.ravel()], axis=1))
        self.add(tree)

    def add(self, legs: Indices) -> None:
        """Legs (M, 2) that are likely too."""
        count = len(self._costs)
        low, high = np.min(legs, axis=1), np.max(legs, axis=1)
        keys = (low * count + high)[low >= self._root]
        self._keys = np.union1d(self._keys, keys)
        self._low, self._high = np.divmod(self._keys, count)
        self._first = np.searchsorted(self._low, np.arange(count + 1))  # of each row
        self._values = self._costs.legs(self._low, self._high)

    def find_tree(self, prices: Array) -> Indices:
        """Edges of the least tree of these legs under prices (N,) of the nodes."""
        from scipy.sparse import csr_array
        from scipy.sparse.csgraph import minimum_spanning_tree

        count = len(self._costs)
        values = self._values + prices[self._low] + prices[self._high]
        values += 1 - np.min(values)  # the tree is the same, and a leg of cost zero would be none
        graph = csr_array((values, self._high, self._first), shape=(count, count))
        tree = minimum_spanning_tree(graph, overwrite=True).tocoo()
        return np.stack([tree.row, tree.col], axis=1)
