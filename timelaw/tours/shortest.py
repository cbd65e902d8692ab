"""The shortest tours: exact for small sets and for lattices, with a proved gap for all others."""

import numpy as np

from timelaw.numerics.array import Array
from timelaw.progress import Progress
from timelaw.tours.ends import Ends, list_visits
from timelaw.tours.graph.distances import NEIGHBOUR_TOLERANCE, list_neighbours
from timelaw.tours.merit import LENGTH, Merit, Searched
from timelaw.tours.search.hamiltonian import find_obstacle, find_path
from timelaw.tours.search.held_karp import bound_by_trees
from timelaw.tours.search.local_search import find_short_cycle
from timelaw.tours.search.subset_dp import MOST_NODES, Move, Start, find_least

EXACT = "all tours compared"
MINIMAL = "legs × the minimal distance"
TREES = "Held–Karp bound"


def find_shortest(
    angles: Array, ends: Ends, progress: Progress | None = None, precision: float = 0.0
) -> Searched:
    """A tour of least total angle, given the rotation angles (N, N) [rad]; the same one every time.

    Where all legs can have the minimal distance, a path or cycle of such legs is found; up to 16
    nodes all tours are compared; otherwise it is the best found, with a lower bound. Distances that are
    equal within the `precision` [rad] of the orientations are taken for equal where that helps the search.
    """
    count = len(angles)
    legs = count - 1 + ends.closed
    minimal = float(np.min(angles[~np.eye(count, dtype=bool)]))
    neighbours = list_neighbours(angles, precision)
    path = None if find_obstacle(neighbours, ends) else find_path(neighbours, ends)
    if path is not None:
        total = sum_costs(angles, path, closed=ends.closed)
        return Searched(path, (Merit(LENGTH, total, legs * minimal, MINIMAL),))
    if count <= MOST_NODES:
        order, total = find_cheapest(angles, ends)
        return Searched(order, (Merit(LENGTH, total, total, EXACT),))
    order = find_short_tour(angles, ends, progress)
    total = sum_costs(angles, order, closed=ends.closed)
    return Searched(order, (bound_length(angles, ends, total, progress),))


def bound_length(angles: Array, ends: Ends, length: float, progress: Progress | None = None) -> Merit:
    """A tour's length beside the best bound known for tours with these ends: exact for small sets."""
    count = len(angles)
    minimal = (count - 1 + ends.closed) * float(np.min(angles[~np.eye(count, dtype=bool)]))
    if length <= minimal * (1 + NEIGHBOUR_TOLERANCE):
        return Merit(LENGTH, length, minimal, MINIMAL)
    if count <= MOST_NODES:
        return Merit(LENGTH, length, find_cheapest(angles, ends)[1], EXACT)
    return Merit(LENGTH, length, max(bound_by_trees(angles, ends, length, progress), minimal), TREES)


def sum_costs(costs: Array, order: tuple[int, ...], *, closed: bool) -> float:
    """Sum of the costs (N, N) of the legs of a tour."""
    visits = list(list_visits(order, closed=closed))
    return float(np.sum(costs[visits[:-1], visits[1:]]))


def find_cheapest(costs: Array, ends: Ends) -> tuple[tuple[int, ...], float]:
    """The cheapest tour of at most 16 nodes, and its cost."""
    count = len(costs)
    moves = [Move(i, j, (j,), float(costs[i, j])) for i in range(count) for j in range(count) if i != j]
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


def find_short_tour(costs: Array, ends: Ends, progress: Progress | None = None) -> tuple[int, ...]:
    """A cheap tour of any size.

    An open tour is a closed one through a further node, at no cost from the ends: from all nodes, or
    only from those given, the others at a cost that no tour pays twice.
    """
    count = len(costs)
    if ends.closed:
        cycle = find_short_cycle(costs, progress)
        first = cycle.index(ends.start or 0)
        return tuple(cycle[first:] + cycle[:first])
    given = [end for end in (ends.start, ends.end) if end is not None]
    wide = np.zeros((count + 1, count + 1))
    wide[:count, :count] = costs
    if given:
        wide[count, :count] = wide[:count, count] = float(np.sum(np.max(costs, axis=1)))
        wide[count, given] = wide[given, count] = 0.0
    cycle = find_short_cycle(wide, progress)
    gate = cycle.index(count)
    path = tuple(cycle[gate + 1 :] + cycle[:gate])
    backwards = path[-1] == ends.start or path[0] == ends.end or (not given and path[0] > path[-1])
    return path[::-1] if backwards else path
