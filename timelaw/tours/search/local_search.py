"""Short tours of many nodes: chains of exchanges by Lin & Kernighan, then kicks; the same tour every time.

Legs are compared by their cost and the prices of their ends that the bound by trees has found: that
changes no tour against another, and tells which legs are likely (Helsgaun 2000).
"""

from random import Random

import numpy as np

from timelaw.numerics.array import Array
from timelaw.progress import Progress, tell
from timelaw.tours.search.costs import Costs, Indices
from timelaw.tours.search.greedy_cycle import join_greedily
from timelaw.tours.search.lin_kernighan import Cycle, Near
from timelaw.tours.search.windows import Window, list_windows

SEED = 20170112
LIKELY, NEIGHBOURS = 10, 6  # nearest nodes, of which the likely ones are tried for new legs
LEAST_KICKS = 1000  # of small sets; otherwise one a node
MOST_AT_ONCE = 1500  # nodes; in a larger set reversals get long, and kicks are tried in windows


def find_short_cycle(costs: Costs, prices: Array, progress: Progress | None = None) -> list[int]:
    """A short closed tour of all nodes, N ≥ 5; `prices` (N,) are those of a bound by trees, or zeros."""
    count = len(costs)
    near = costs.nearest(min(LIKELY, count - 1))
    likely = choose_likely(costs, prices, near)
    cycle = Cycle(join_greedily(costs, prices, near), costs.price(prices), likely)
    cycle.improve(range(count))
    random = Random(SEED)
    if count <= MOST_AT_ONCE:
        _kick(cycle, random, max(count, LEAST_KICKS), progress)
        return cycle.nodes
    nodes, visited = cycle.nodes, 0
    for members in list_windows(costs):
        window = Window(costs, prices, likely, nodes, members)
        _kick(window.cycle, random, len(window), None)
        nodes = window.join()
        visited += len(window)
        tell(progress, "tour", min(visited, 2 * count), 2 * count)
    return nodes


def _kick(cycle: Cycle, random: Random, kicks: int, progress: Progress | None) -> None:
    for kick in range(kicks):
        cycle.kick(random)
        if kick % 100 == 0:
            tell(progress, "tour", kick, kicks)


def choose_likely(costs: Costs, prices: Array, near: Indices) -> Near:
    """Of the nearest nodes (N, k) of each those at the cheapest priced legs, with these costs."""
    origins = np.repeat(np.arange(len(costs)), near.shape[1])
    values = costs.legs(origins, near.ravel()).reshape(near.shape) + prices[near] + prices[:, None]
    order = np.argsort(values, axis=1, kind="stable")[:, :NEIGHBOURS]
    nodes, legs = np.take_along_axis(near, order, axis=1), np.take_along_axis(values, order, axis=1)
    return [list(zip(*row, strict=True)) for row in zip(nodes.tolist(), legs.tolist(), strict=True)]
