"""Hamiltonian paths and cycles in the nearest-neighbour graph, by Pósa's rotations.

A path 1 … k whose end has a neighbour i on the path becomes 1 … i, k … i+1: a new end, the same
nodes. Extending where possible and rotating otherwise finds Hamiltonian paths in well-connected
graphs in a number of steps that grows little faster than the number of nodes (Pósa 1976). A tour
along nearest neighbours only is proved shortest by its length alone: legs × minimal distance.
"""

from random import Random

import numpy as np
from numpy.typing import NDArray

from timelaw.errors import Fault, InputError
from timelaw.tours.distance import NEIGHBOUR_TOLERANCE

SEED = 20170112
STEPS_PER_NODE = 400  # rotations before a fresh start; a path is found after about 10 a node
STARTS = 50


def shortest(angles: NDArray[np.float64], *, closed: bool) -> tuple[int, ...]:
    """A tour from node 0 whose legs are all minimal; the same one every time.

    Raises:
        InputError: none was found.
    """
    near = angles <= float(np.min(angles[~np.eye(len(angles), dtype=bool)])) + NEIGHBOUR_TOLERANCE
    np.fill_diagonal(near, val=False)
    neighbours = [list(map(int, np.flatnonzero(row))) for row in near]
    random = Random(SEED)
    for _ in range(STARTS):
        path = _grow(neighbours, random, closed=closed)
        if path is not None:
            return tuple(path)
    kind = "closed tour" if closed else "tour"
    message = f"found no {kind} whose legs all have the minimal distance; give the order as a list of labels"
    raise InputError(Fault(message, "route.tour"))


def _grow(neighbours: list[list[int]], random: Random, *, closed: bool) -> list[int] | None:
    """One attempt: extend or rotate until all nodes are on the path, and for a cycle until it closes."""
    count = len(neighbours)
    path, place = [0], {0: 0}
    for _ in range(STEPS_PER_NODE * count):
        end = path[-1]
        if len(path) == count and (not closed or 0 in neighbours[end]):
            return path
        fresh = [n for n in neighbours[end] if n not in place]
        if fresh:
            node = _pick(fresh, random)
            place[node] = len(path)
            path.append(node)
            continue
        others = [n for n in neighbours[end] if n != path[-2]]
        if not others:
            return None
        turn = place[_pick(others, random)] + 1
        path[turn:] = path[turn:][::-1]
        for i in range(turn, len(path)):
            place[path[i]] = i
    return None


def _pick(items: list[int], random: Random) -> int:
    """A random item by `random()` alone, the one method whose sequence Python promises to keep."""
    return items[int(random.random() * len(items))]
