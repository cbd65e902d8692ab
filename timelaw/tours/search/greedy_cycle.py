"""A closed tour to begin from: the cheapest legs first, as long as they make stretches; then those joined."""

import numpy as np

from timelaw.numerics.array import Array
from timelaw.tours.search.costs import Costs, Indices


def join_greedily(costs: Costs, prices: Array, near: Indices) -> list[int]:
    """A cycle through all nodes, of near legs (N, k) where it can be, priced legs compared."""
    ends = _link(costs, prices, near)
    free = np.array([len(linked) < 2 for linked in ends])
    nodes: list[int] = []
    node = int(np.argmax(free))
    while True:
        stretch = _follow(ends, node)
        free[[stretch[0], stretch[-1]]] = False
        nodes += stretch
        if not np.any(free):
            return nodes
        node = int(np.argmin(np.where(free, costs.row(stretch[-1]) + prices, np.inf)))


def _link(costs: Costs, prices: Array, near: Indices) -> list[list[int]]:
    """Of each node the one or two that it is linked with; the links make stretches, and no ring."""
    count = len(costs)
    origins = np.repeat(np.arange(count), near.shape[1])
    low, high = np.minimum(origins, near.ravel()), np.maximum(origins, near.ravel())
    low, high = np.divmod(np.unique(low * count + high), count)
    order = np.argsort(costs.legs(low, high) + prices[low] + prices[high], kind="stable")
    linked: list[list[int]] = [[] for _ in range(count)]
    other_end = list(range(count))
    for i, j in zip(low[order].tolist(), high[order].tolist(), strict=True):
        if len(linked[i]) < 2 and len(linked[j]) < 2 and other_end[i] != j:
            linked[i].append(j)
            linked[j].append(i)
            first, last = other_end[i], other_end[j]
            other_end[first], other_end[last] = last, first
    return linked


def _follow(linked: list[list[int]], node: int) -> list[int]:
    """The stretch that begins at a node."""
    stretch, before = [node], -1
    while (onward := next((n for n in linked[node] if n != before), None)) is not None:
        before, node = node, onward
        stretch.append(node)
    return stretch
