"""Hamiltonian paths and cycles in the nearest-neighbour graph, by Pósa's rotations.

A path 1 … k whose end has a neighbour i on the path becomes 1 … i, k … i+1: a new end, the same
nodes. Extending where possible and rotating otherwise finds Hamiltonian paths in well-connected
graphs in a number of steps that grows little faster than the number of nodes (Pósa 1976). A tour
along nearest neighbours only is proved shortest by its length alone: legs × minimal distance.
"""

from collections.abc import Sequence
from random import Random

from timelaw.tours.ends import Ends

Graph = Sequence[Sequence[int]]

SEED = 20170112
STEPS_PER_NODE = 400  # rotations before a fresh start; a path is found after about 10 a node
STARTS = 50


def find_path(neighbours: Graph, ends: Ends) -> tuple[int, ...] | None:
    """A path or cycle through all nodes along the edges of a graph; the same one every time.

    None if none was found; `obstacle` may say why there is none.
    """
    if not ends.closed and ends.start is None and ends.end is not None:
        path = find_path(neighbours, Ends(False, ends.end))
        return None if path is None else path[::-1]
    random = Random(SEED)
    last = (ends.start or 0) if ends.closed else ends.end
    first = next((node for node, near in enumerate(neighbours) if len(near) == 1), 0)  # it must be an end
    for _ in range(STARTS):
        if ends.closed or ends.start is not None:
            first = ends.start or 0
        grown = _grow(neighbours, random, first, last, closed=ends.closed)
        if grown is not None:
            return tuple(grown)
        first = int(random.random() * len(neighbours))
    return None


def find_obstacle(neighbours: Graph, ends: Ends) -> tuple[str, list[int]] | None:
    """Why a graph plainly has no such path or cycle, and the nodes to blame; None if nothing is seen."""
    lonely = [node for node, near in enumerate(neighbours) if not near]
    if lonely:
        return "with no neighbour at the minimal distance", lonely
    cut_off = sorted(set(range(len(neighbours))) - _reached(neighbours, ends.start or 0))
    if cut_off:
        return "not reachable by legs of the minimal distance", cut_off
    dead_ends = [node for node, near in enumerate(neighbours) if len(near) == 1]
    if ends.closed and dead_ends:
        return "with one neighbour only, where a closed tour needs two", dead_ends
    inner = [node for node in dead_ends if node not in (ends.start, ends.end)]
    free = 2 - sum(end is not None for end in (ends.start, ends.end))
    if not ends.closed and len(inner) > free:
        return "with one neighbour only, where all but the ends need two", inner
    return None


def _reached(neighbours: Graph, start: int) -> set[int]:
    """The nodes connected with `start`."""
    seen, waiting = {start}, [start]
    while waiting:
        fresh = [node for node in neighbours[waiting.pop()] if node not in seen]
        seen.update(fresh)
        waiting += fresh
    return seen


def _grow(
    neighbours: Graph, random: Random, first: int, last: int | None, *, closed: bool
) -> list[int] | None:
    """One attempt: extend or rotate until all nodes are on the path and it ends as it should."""
    count = len(neighbours)
    path, place = [first], {first: 0}
    for _ in range(STEPS_PER_NODE * count):
        end = path[-1]
        arrived = last is None or (last in neighbours[end] if closed else last == end)
        if len(path) == count and arrived:
            return path
        fresh = [n for n in neighbours[end] if n not in place]
        if fresh:
            node = _pick(fresh, random)
            place[node] = len(path)
            path.append(node)
            continue
        others = [n for n in neighbours[end] if len(path) > 1 and n != path[-2]]
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
