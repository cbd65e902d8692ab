"""How short a tour can be at best: Held & Karp's bound by trees, raised by prices on the nodes (1970, 1971).

Take any prices π on the nodes and let a leg cost c_ij + π_i + π_j. An open tour is a tree in which
all nodes have two legs, but the first and last one; so it costs at least
    least tree + π_first + π_last - 2 Σπ,
with the two cheapest nodes for ends that are free. A closed tour is a tree on all nodes but one, and
two legs of that one. Every choice of prices gives a bound; nodes with too many legs in the tree are
made dearer, those with too few cheaper, and the best bound counts.
"""

import numpy as np

from timelaw.numerics.array import Array
from timelaw.progress import Progress
from timelaw.tours.ends import Ends

STEPS = 250
PATIENCE = 12  # steps without a better bound before they get smaller
ROUNDING = 1e-12  # of the sum of all that is added up, per node
MOMENTUM = 0.6  # of the last direction that goes into the next


def bound_by_trees(costs: Array, ends: Ends, reached: float, progress: Progress | None = None) -> float:
    """A number that no tour's cost is below, under symmetric costs (N, N), N ≥ 3.

    `reached` is what some tour costs: it sets the size of the steps.
    """
    count = len(costs)
    prices = np.zeros(count)
    best, best_prices, since = -np.inf, prices, 0
    scale, direction = 1.0, np.zeros(count)
    for step in range(STEPS):
        value, degrees = _relaxed(costs, prices, ends)
        if value > best:
            best, best_prices, since = value, prices.copy(), 0
        else:
            since += 1
        excess = degrees - 2.0
        if not np.any(excess) or reached - best <= ROUNDING * count * abs(reached):
            break  # the tree is a tour, or as dear as one
        if since >= PATIENCE:
            scale, since, prices, direction = scale / 2, 0, best_prices.copy(), np.zeros(count)
        direction = excess + MOMENTUM * direction
        prices = prices + scale * max(reached - value, 0.0) / float(excess @ excess) * direction
        if progress is not None:
            progress("lower bound", step, STEPS)
    slack = ROUNDING * count * float(np.max(np.abs(costs)) + np.max(np.abs(best_prices)))
    return min(best - slack * count, reached)


def _relaxed(costs: Array, prices: Array, ends: Ends) -> tuple[float, Array]:
    """The bound for these prices, and how many legs each node has in the tree it comes from."""
    priced = costs + prices[:, None] + prices[None, :]
    total = 2 * float(np.sum(prices))
    if ends.closed:
        tree, degrees = _least_tree(priced[1:, 1:])
        one, two = np.argsort(priced[0, 1:], kind="stable")[:2]
        degrees = np.concatenate([[2.0], degrees])
        degrees[[1 + one, 1 + two]] += 1
        return tree + float(priced[0, 1 + one] + priced[0, 1 + two]) - total, degrees
    tree, degrees = _least_tree(priced)
    given = [node for node in (ends.start, ends.end) if node is not None]
    others = [int(node) for node in np.argsort(prices, kind="stable")[:3] if node not in given]
    tips = [*given, *others][:2]
    degrees[tips] += 1
    return tree + float(np.sum(prices[tips])) - total, degrees


def _least_tree(costs: Array) -> tuple[float, Array]:
    """Cost and degrees of a least spanning tree, by Prim's rule from node 0."""
    count = len(costs)
    degrees, total = np.zeros(count), 0.0
    parent = np.zeros(count, dtype=int)
    outside = costs[0].copy()
    outside[0] = np.inf
    inside = np.zeros(count, dtype=bool)
    inside[0] = True
    for _ in range(count - 1):
        node = int(np.argmin(outside))
        total += float(outside[node])
        degrees[node] += 1
        degrees[parent[node]] += 1
        inside[node] = True
        outside[node] = np.inf
        nearer = (costs[node] < outside) & ~inside
        parent[nearer] = node
        outside[nearer] = costs[node][nearer]
    return total, degrees
