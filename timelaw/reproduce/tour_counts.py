"""How many shortest tours there are: `python -m timelaw.reproduce.tour_counts LATTICE`, for small lattices.

Directed paths and cycles by minimal legs, counted by dynamic programming over subsets; by how many
nodes they go straight on, too. For the 24-cell besides them the paths of table 1 of [MMB2017], where
the twelve representatives are at π/3 only if q_i·q_j = ½, not -½.
"""

from collections.abc import Sequence

import numpy as np

from timelaw.errors import TimelawError
from timelaw.orientations.lattices import LATTICES, make_lattice
from timelaw.reproduce.command import run_main
from timelaw.tours.graph.minimal_legs import MinimalLegs
from timelaw.tours.search.subset_dp import MOST_NODES, Move, Start, count_all

Graph = Sequence[Sequence[int]]
TABLE_1_TOLERANCE = 1e-9


def count_paths(neighbours: Graph, start: int) -> int:
    """Directed Hamiltonian paths from a node."""
    count = len(neighbours)
    return count_all(count, count, _steps(neighbours), [Start(start, start)], range(count))


def count_cycles(neighbours: Graph, start: int) -> int:
    """Directed Hamiltonian cycles, each counted once, from a node and back to it."""
    return count_all(len(neighbours), len(neighbours), _steps(neighbours), [Start(start, None)], [start])


def count_by_straight_nodes(graph: MinimalLegs, start: int, *, closed: bool) -> dict[int, int]:
    """How many paths or cycles from a node have 0, 1, 2, … straight inner nodes."""
    count, most = len(graph), graph.counting_bound(closed)
    arcs = [(i, j) for i, near in enumerate(graph.neighbours) for j in near]
    place = {
        (arc, done): count + at * (most + 1) + done for at, arc in enumerate(arcs) for done in range(most + 1)
    }
    moves = [Move(i, place[(i, j), 0], (j,), 0.0) for i, j in arcs]
    for i, j in arcs:
        for k in graph.neighbours[j]:
            more = graph.onward.get((i, j)) == k
            moves += [
                Move(place[(i, j), done], place[(j, k), done + more], (k,), 0.0)
                for done in range(most + 1 - more)
                if k != i
            ]
    first = Start(start, None if closed else start)
    states = count + len(arcs) * (most + 1)
    return {
        done: count_all(
            count, states, moves, [first], [place[arc, done] for arc in arcs if not closed or arc[1] == start]
        )
        for done in range(most + 1)
    }


def _steps(neighbours: Graph) -> list[Move]:
    return [Move(i, j, (j,), 0.0) for i, near in enumerate(neighbours) for j in near]


def _table_1(quaternions: np.ndarray) -> Graph:
    """Neighbours at the arc π/3 between the representatives as they stand."""
    return [
        list(map(int, np.flatnonzero(np.abs(row - 0.5) < TABLE_1_TOLERANCE)))
        for row in quaternions @ quaternions.T
    ]


def main(arguments: Sequence[str]) -> None:
    """Print the counts of a lattice."""
    names = [name for name in LATTICES if len(make_lattice(name)) <= MOST_NODES]
    if len(arguments) != 1 or arguments[0] not in names:
        raise TimelawError(f"give one lattice: {', '.join(names)}; the others have too many tours to count")
    graph = MinimalLegs(make_lattice(arguments[0]))
    nodes = range(len(graph))
    if arguments[0] == "24-cell":
        table = _table_1(graph.quaternions)
        every = sum(count_paths(table, node) for node in nodes)
        first = count_paths(table, 0)
        print(f"table 1 of [MMB2017]: {first} directed shortest paths from node 1, {every} in all")
    every = sum(count_paths(graph.neighbours, node) for node in nodes)
    print(
        f"on SO(3): {count_paths(graph.neighbours, 0)} from node 1, {every} in all; "
        f"{count_cycles(graph.neighbours, 0)} closed ones"
    )
    for kind, closed in (("open", False), ("closed", True)):
        found = count_by_straight_nodes(graph, 0, closed=closed)
        listing = ", ".join(f"{number} with {done}" for done, number in found.items())
        print(f"{kind}, from node 1, by straight inner nodes: {listing}")


if __name__ == "__main__":
    run_main(main)
