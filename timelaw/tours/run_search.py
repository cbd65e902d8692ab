"""Search for tours made of few straight runs: `python -m timelaw.tours.run_search LATTICE RUNS [closed]`.

What it finds goes into `data/fewest_stops.json` by hand.
"""

import json
import sys
from collections.abc import Sequence
from random import Random

from timelaw.orientations.lattices import lattice
from timelaw.tours.lines import Lines

RESTARTS = 100_000
STEPS = 30_000  # of one attempt, before it starts afresh in another order


def search(
    lines: Lines, runs: int, *, closed: bool, seed: int, restarts: int = RESTARTS
) -> tuple[int, ...] | None:
    """A tour from node 0 made of at most `runs` straight runs, by depth-first search with restarts."""
    random = Random(seed)
    for _ in range(restarts):
        found = _Attempt(lines, closed, random).run(runs)
        if found is not None:
            return found
    return None


class _Attempt:
    """One depth-first search over sequences of runs, in a random order of equally good continuations.

    A run of l legs on a circle that allows m wastes m - l; `waste` is what may still be wasted.
    Long runs that end where few neighbours are left come first.
    """

    def __init__(self, lines: Lines, closed: bool, random: Random) -> None:
        self.lines, self.closed, self.random = lines, closed, random
        count = len(lines.quaternions)
        self.near = [sum(1 << j for j in nearest) for nearest in lines.neighbours]
        self.ways = [[lines.line(i, j) for j in nearest] for i, nearest in enumerate(lines.neighbours)]
        self.longest = max(len(line) for ways in self.ways for line in ways)
        self.full, self.steps, self.path = (1 << count) - 1, STEPS, [0]

    def run(self, runs: int) -> tuple[int, ...] | None:
        legs = len(self.near) - 1 + self.closed
        return tuple(self.path) if self._extend(0, 1, runs * self.longest - legs) else None

    def _extend(self, last: int, visited: int, waste: int) -> bool:
        self.steps -= 1
        if self.steps < 0:
            return False
        if self.closed and self._comes_home(last, visited, waste):
            return True
        if visited == self.full:
            return not self.closed
        if self._stranded(last, visited):
            return False
        for _, lost, nodes in sorted(self._continuations(last, visited, waste)):
            mask = sum(1 << node for node in nodes)
            self.path += nodes
            if self._extend(nodes[-1], visited | mask, waste - lost):
                return True
            del self.path[-len(nodes) :]
            if self.steps < 0:
                return False
        return False

    def _comes_home(self, last: int, visited: int, waste: int) -> bool:
        """Whether one more run visits all that is left and ends at node 0; it is taken."""
        left = len(self.near) - visited.bit_count()
        for line in self.ways[last]:
            new = line[:left]
            fits = len(line) > left and line[left] == 0 and self.longest - left - 1 <= waste
            if fits and not any(visited >> node & 1 for node in new):
                self.path += new
                return True
        return False

    def _continuations(self, last: int, visited: int, waste: int) -> list[tuple[float, int, list[int]]]:
        found = []
        for line in self.ways[last]:
            free = next((i for i, node in enumerate(line) if visited >> node & 1), len(line))
            for length in range(max(1, self.longest - waste), free + 1):
                nodes, lost = line[:length], self.longest - length
                after = visited | sum(1 << node for node in nodes)
                left = (self.near[nodes[-1]] & ~after).bit_count()
                found.append((64 * lost + left + 4 * self.random.random(), lost, nodes))
        return found

    def _stranded(self, last: int, visited: int) -> bool:
        """Whether some node can no longer be reached, or more than one only as the last."""
        reachable = (self.full & ~visited) | 1 << last | (1 if self.closed else 0)
        ends = 0
        for node, near in enumerate(self.near):
            if visited >> node & 1:
                continue
            ways = (near & reachable).bit_count()
            ends += ways == 1
            if ways == 0 or ends > (0 if self.closed else 1):
                return True
        return False


def main(arguments: Sequence[str]) -> None:
    """Search and print a tour as the data file has it."""
    name, runs, closed = arguments[0], int(arguments[1]), "closed" in arguments[2:]
    lines = Lines(lattice(name))
    order = search(lines, runs, closed=closed, seed=1)
    print(json.dumps(order))


if __name__ == "__main__":
    main(sys.argv[1:])
