"""The shortest tours: exact for small sets and for lattices, with a proved gap for all others."""

import numpy as np

from timelaw.progress import Progress
from timelaw.tours.ends import Ends, list_visits
from timelaw.tours.graph.distances import NEIGHBOUR_TOLERANCE
from timelaw.tours.merit import LENGTH, Merit, Searched
from timelaw.tours.search.costs import Costs, GatedCosts
from timelaw.tours.search.hamiltonian import Graph, find_obstacle, find_path
from timelaw.tours.search.held_karp import TreeBound
from timelaw.tours.search.local_search import find_short_cycle
from timelaw.tours.search.subset_dp import MOST_NODES, Move, Start, find_least

EXACT = "all tours compared"
MINIMAL = "legs × the minimal distance"
TREES = "Held–Karp bound"
LOOSE = 1.3  # times the least tree is above a tour, to begin with


def find_shortest(
    costs: Costs, neighbours: Graph, minimal: float, ends: Ends, progress: Progress | None = None
) -> Searched:
    """A tour of least total angle, given the angles [rad], the least of them, and who is so near to whom.

    Where all legs can have the minimal distance, a path or cycle of such legs is found; up to 16
    nodes all tours are compared; otherwise it is the best found, with a lower bound. It is the same one
    every time.
    """
    legs = len(costs) - 1 + ends.closed
    path = None if find_obstacle(neighbours, ends) else find_path(neighbours, ends)
    if path is not None:
        return Searched(
            path, (Merit(LENGTH, sum_costs(costs, path, closed=ends.closed), legs * minimal, MINIMAL),)
        )
    if len(costs) <= MOST_NODES:
        order, total = find_cheapest(costs, ends)
        return Searched(order, (Merit(LENGTH, total, total, EXACT),))
    trees = TreeBound(costs, ends)
    order = find_short_tour(costs, ends, trees, progress)
    total = sum_costs(costs, order, closed=ends.closed)
    return Searched(order, (Merit(LENGTH, total, max(trees.find(total, progress), legs * minimal), TREES),))


def bound_length(
    costs: Costs, minimal: float, ends: Ends, length: float, progress: Progress | None = None
) -> Merit:
    """A tour's length beside the best bound known for tours with these ends: exact for small sets."""
    least = (len(costs) - 1 + ends.closed) * minimal
    if length <= least * (1 + NEIGHBOUR_TOLERANCE):
        return Merit(LENGTH, length, least, MINIMAL)
    if len(costs) <= MOST_NODES:
        return Merit(LENGTH, length, find_cheapest(costs, ends)[1], EXACT)
    return Merit(LENGTH, length, max(TreeBound(costs, ends).find(length, progress), least), TREES)


def sum_costs(costs: Costs, order: tuple[int, ...], *, closed: bool) -> float:
    """Sum of the costs of the legs of a tour."""
    visits = np.array(list_visits(order, closed=closed))
    return float(np.sum(costs.legs(visits[:-1], visits[1:])))


def find_cheapest(costs: Costs, ends: Ends) -> tuple[tuple[int, ...], float]:
    """The cheapest tour of at most 16 nodes, and its cost."""
    count = len(costs)
    rows = [costs.row(i).tolist() for i in range(count)]
    moves = [Move(i, j, (j,), rows[i][j]) for i in range(count) for j in range(count) if i != j]
    found = find_least(count, count, moves, *list_places(count, ends))
    assert found is not None  # every order is a tour
    return open_cycle(found.nodes, closed=ends.closed), found.cost


def list_places(count: int, ends: Ends) -> tuple[list[Start], list[int]]:
    """Where the moves of a tour may start, and at which node they may end."""
    if ends.closed:
        first = ends.start or 0
        return [Start(first, None)], [first]
    starts = range(count) if ends.start is None else [ends.start]
    return [Start(i, i) for i in starts], [ends.end] if ends.end is not None else list(range(count))


def open_cycle(nodes: tuple[int, ...], *, closed: bool) -> tuple[int, ...]:
    """The order of visits from the nodes as moves visit them: a closed tour visits its first node last."""
    return nodes[-1:] + nodes[:-1] if closed else nodes


def find_short_tour(
    costs: Costs, ends: Ends, trees: TreeBound, progress: Progress | None = None
) -> tuple[int, ...]:
    """A cheap tour of any size; the prices of the bound by `trees` are raised for it.

    An open tour is a closed one through a further node, at no cost from the ends.
    """
    count = len(costs)
    trees.ascend(LOOSE * trees.value, progress)
    if ends.closed:
        cycle = find_short_cycle(costs, trees.prices, progress)
        first = cycle.index(ends.start or 0)
        return tuple(cycle[first:] + cycle[:first])
    given = tuple(end for end in (ends.start, ends.end) if end is not None)
    toll = -float(np.min(trees.prices[list(given)] if given else trees.prices))
    cycle = find_short_cycle(GatedCosts(costs, given), np.append(trees.prices, toll), progress)
    gate = cycle.index(count)
    path = tuple(cycle[gate + 1 :] + cycle[:gate])
    backwards = path[-1] == ends.start or path[0] == ends.end or (not given and path[0] > path[-1])
    return path[::-1] if backwards else path
