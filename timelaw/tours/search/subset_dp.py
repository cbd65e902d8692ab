"""Dynamic programming over subsets of the orientations (Held & Karp 1962): exact, for small sets.

A state is where the tour stands, a node alone or with the direction it was reached in; a move goes
from state to state and visits nodes that were not visited. Every tour is a sequence of moves, so
the least cost, and the number of tours, over all subsets of visited nodes are those of all tours.
A closed tour starts with nothing visited and visits its first node last.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array

MOST_NODES = 16  # 2^16 subsets of 16 places: half a second for single legs
MOST_CELLS = 20_000_000  # states × subsets: 160 MB
TIE = 1e-9  # of the cost of the whole; costs that differ by less are equal


@dataclass(frozen=True)
class Move:
    """From state `origin` to state `target`, visiting `nodes` in this order."""

    origin: int
    target: int
    nodes: tuple[int, ...]
    cost: float

    @property
    def mask(self) -> int:
        """The nodes as bits."""
        return sum(1 << node for node in self.nodes)


@dataclass(frozen=True)
class Start:
    """A state to start from, and the node that is visited there already, if any."""

    state: int
    node: int | None


@dataclass(frozen=True)
class Found:
    """The least cost, and the nodes in the order of visits."""

    cost: float
    nodes: tuple[int, ...]


def find_least(
    count: int, states: int, moves: Sequence[Move], starts: Sequence[Start], ends: Iterable[int]
) -> Found | None:
    """The cheapest sequence of moves that visits all of `count` nodes, from a start to one of the end states.

    None if there is none at all.
    """
    cost = np.full((states, 1 << count), np.inf)
    for start in starts:
        cost[start.state, 0 if start.node is None else 1 << start.node] = 0.0

    def extend(move: Move, before: NDArray[np.int64]) -> None:
        after = before | move.mask
        cost[move.target, after] = np.minimum(cost[move.target, after], cost[move.origin, before] + move.cost)

    _by_size(count, moves, extend)
    full = (1 << count) - 1
    best = min(ends, key=lambda state: float(cost[state, full]))
    if not np.isfinite(cost[best, full]):
        return None
    first, nodes = _traced(
        cost, moves, {(s.state, 0 if s.node is None else 1 << s.node) for s in starts}, best
    )
    opening = {s.state: s.node for s in starts}[first]
    return Found(float(cost[best, full]), (() if opening is None else (opening,)) + nodes)


def count_all(
    count: int, states: int, moves: Sequence[Move], starts: Sequence[Start], ends: Iterable[int]
) -> int:
    """How many different sequences of moves visit all nodes."""
    ways = np.zeros((states, 1 << count), dtype=np.int64)
    for start in starts:
        ways[start.state, 0 if start.node is None else 1 << start.node] += 1

    def extend(move: Move, before: NDArray[np.int64]) -> None:
        ways[move.target, before | move.mask] += ways[move.origin, before]

    _by_size(count, moves, extend)
    return int(sum(ways[state, -1] for state in ends))


def _by_size(count: int, moves: Sequence[Move], extend: Callable[[Move, NDArray[np.int64]], None]) -> None:
    """Apply every move to all subsets that it can extend, small subsets first."""
    subsets = np.arange(1 << count, dtype=np.int64)
    sizes = np.zeros(1 << count, dtype=np.int64)
    for node in range(count):
        sizes += subsets >> node & 1
    masks = [(move, move.mask) for move in moves]
    for size in range(count):
        layer = subsets[sizes == size]
        without: dict[int, NDArray[np.int64]] = {}
        for move, mask in masks:
            if mask not in without:
                without[mask] = layer[(layer & mask) == 0]
            if len(without[mask]):
                extend(move, without[mask])


def _traced(
    cost: Array, moves: Sequence[Move], starts: set[tuple[int, int]], state: int
) -> tuple[int, tuple[int, ...]]:
    """The first state, and the nodes visited after it, of a cheapest way to the full set at `state`."""
    into: dict[int, list[Move]] = {}
    for move in moves:
        into.setdefault(move.target, []).append(move)
    mask = cost.shape[1] - 1
    nodes: tuple[int, ...] = ()
    tie = TIE * abs(cost[state, mask])
    while (state, mask) not in starts or (mask and cost[state, mask] > 0):
        here = cost[state, mask]
        for move in into[state]:
            before = mask & ~move.mask
            if move.mask & ~mask or not np.isfinite(cost[move.origin, before]):
                continue
            if abs(cost[move.origin, before] + move.cost - here) <= tie:
                nodes, state, mask = move.nodes + nodes, move.origin, before
                break
    return state, nodes
