"""Tours of minimal legs with few corners, or with little turning: a search that can prove there are none.

A tour is a sequence of runs; each costs the corner it begins with: 1 when stops are counted, the
turn of the axis when that is. Depth first over sequences of runs. What makes it fast: a node still to
visit can be reached by a run of at most l legs, l from the circles through it that are still free;
it needs 1/l of a run, and the sum over all nodes, rounded up, is a bound on the runs.

Where isometries of the set take any leg to any other, as in the lattices, one first leg is enough
for tours with free ends, and more can be left out:

- Some reading of a closed tour of cost C and n legs has cost at most C k/n in its first k legs, at
  every corner; and of an open tour read from one end or the other, the cost up to the run with the
  middle leg is at most C/2.
- Second runs that isometries leaving the first one in place take to each other are tried once.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import lcm
from random import Random

from timelaw.tours.graph.great_circles import GreatCircle, list_circles
from timelaw.tours.graph.minimal_legs import MinimalLegs
from timelaw.tours.graph.symmetry import find_stabiliser

Corner = Callable[[int, int, int], float]

ROUNDING = 1e-9  # of costs
SPREAD = 16  # how far chance may push a continuation back, in units of one neighbour left over
PROMISE = 4  # units for a neighbour that is left over where a run ends
LOSS = 64  # units for a leg less than a run could have


@dataclass
class RunSearch:
    """All tours of minimal legs whose corners cost at most `budget`.

    `corner(i, j, k)` is what turning at j costs. `random` shuffles equally good continuations,
    `steps` ends an attempt; without them the search is complete. Without `alike` it is one for tours
    from the node `start`, and to `end` if that is given, in any set.
    """

    graph: MinimalLegs
    closed: bool
    budget: float
    corner: Corner
    random: Random | None = None
    steps: int | None = None
    alike: bool = True
    start: int = 0
    end: int | None = None
    visited_states: int = 0

    def __post_init__(self) -> None:
        graph, count = self.graph, len(self.graph)
        self.legs = count - 1 + self.closed
        self.full = (1 << count) - 1
        self.near = [sum(1 << j for j in nearest) for nearest in graph.neighbours]
        self.ways = [[tuple(graph.line(i, j)) for j in nearest] for i, nearest in enumerate(graph.neighbours)]
        self.unit = lcm(*range(1, graph.longest + 1))
        self.circles: list[tuple[GreatCircle, dict[int, int]]] = [
            (circle, {}) for circle in list_circles(graph)
        ]
        self.costs = {
            (i, j, k): self.corner(i, j, k)
            for j, nearest in enumerate(graph.neighbours)
            for i in nearest
            for k in nearest
            if k != i and graph.onward.get((i, j)) != k
        }
        self.least = min(self.costs.values(), default=0.0)

    def run(self) -> tuple[int, ...] | None:
        """The first tour found; None if there is none, or `steps` are used up (`finished` tells which)."""
        ways, self.visited_states = self.ways[self.start], 0
        self.home = 1 << self.start if self.closed else 0
        for first in ways[:1] if self.alike else self._shuffled(ways):
            for length in range(len(first), 0, -1):
                if not self._in_time(0.0, 0, length):
                    break
                self.path = [self.start, *first[:length]]
                if self._extend(sum(1 << node for node in self.path), 0.0, 1):
                    return tuple(self.path)
        return None

    @property
    def finished(self) -> bool:
        """Whether the search was complete."""
        return self.steps is None or self.visited_states <= self.steps

    def _extend(self, visited: int, cost: float, runs: int) -> bool:
        self.visited_states += 1
        if not self.finished or cost > self.budget + ROUNDING:
            return False
        if self.closed and self._comes_home(visited, cost):
            return True
        if visited == self.full:
            return not self.closed and self.end in (None, self.path[-1])
        if self.end is not None and visited >> self.end & 1:
            return False
        needed = self._runs_needed(visited)
        if needed is None or cost + (needed + self.closed) * self.least > self.budget + ROUNDING:
            return False
        last, legs = self.path[-1], len(self.path) - 1
        for _, price, nodes in self._continuations(visited, cost, first=runs == 1):
            self.path += nodes
            if self._extend(visited | sum(1 << node for node in nodes), price, runs + 1):
                return True
            del self.path[legs + 1 :]
            if not self.finished:
                return False
        assert self.path[-1] == last
        return False

    def _comes_home(self, visited: int, cost: float) -> bool:
        """Whether one more run visits all that is left and ends where the tour began; it is taken."""
        left = len(self.near) - visited.bit_count()
        before, last = self.path[-2:]
        for line in self.ways[last]:
            new = line[:left]
            if len(line) <= left or line[left] != self.start or any(visited >> node & 1 for node in new):
                continue
            arrival = new[-1] if new else last
            entry = self.costs.get((before, last, line[0]))
            closing = self.costs.get((arrival, self.start, self.path[1]))
            if entry is not None and closing is not None and cost + entry + closing <= self.budget + ROUNDING:
                self.path += new
                return True
        return False

    def _continuations(
        self, visited: int, cost: float, *, first: bool
    ) -> list[tuple[float, float, tuple[int, ...]]]:
        """(rank, cost, nodes) of all runs that may come next, the most promising first."""
        before, last = self.path[-2:]
        legs, found = len(self.path) - 1, []
        for line in self._second_runs(last) if first and self.alike else self.ways[last]:
            price = self.costs.get((before, last, line[0]))
            if price is None:
                continue
            after = visited
            for length, node in enumerate(line, 1):
                if visited >> node & 1:
                    break
                after |= 1 << node
                if not self._in_time(cost + price, legs, legs + length):
                    continue
                left = (self.near[node] & ~after).bit_count()
                rank = LOSS * (self.graph.longest - length + price / self.least) + PROMISE * left
                chance = SPREAD * self.random.random() if self.random else 0.0
                found.append((rank + chance, cost + price, line[:length]))
        return sorted(found)

    def _in_time(self, cost: float, before: int, legs: int) -> bool:
        """Whether some reading of the tour can have cost this much with a run from `before` to `legs` legs.

        Open: if the run is not past the middle leg, and what must still be added until the run with the
        middle leg begins counts too. Closed: the corner at its start has cost something already.
        """
        if not self.alike:
            return True
        if self.closed:
            return (cost + self.least) * self.legs <= self.budget * legs + ROUNDING
        middle = (self.legs - 1) // 2 + 1
        runs = -(-max(middle - legs, 0) // self.graph.longest)
        return before >= middle or cost + runs * self.least <= self.budget / 2 + ROUNDING

    def _shuffled(self, ways: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
        """Long ones first, equally long ones by chance."""
        return sorted(ways, key=lambda line: (-len(line), self.random.random() if self.random else 0.0))

    def _second_runs(self, last: int) -> list[tuple[int, ...]]:
        """Lines from `last`, one of each class that the isometries fixing the first leg make."""
        stabiliser = find_stabiliser(self.graph.quaternions, 0, self.path[1])
        kept: dict[int, tuple[int, ...]] = {}
        for line in self.ways[last]:
            representative = min(nodes[line[0]] for nodes in stabiliser)
            kept.setdefault(representative, line)
        return list(kept.values())

    def _runs_needed(self, visited: int) -> int | None:
        """At least so many more runs; None if some node can no longer be visited."""
        free = self.full & ~visited
        open_nodes = free | 1 << self.path[-1] | self.home
        goals = free | self.home
        reach = 0
        for circle, known in self.circles:
            free_here = open_nodes & circle.mask
            found = known.get(free_here)
            if found is None:
                found = known[free_here] = circle.reach(free_here, len(self.near))
            reach |= found
        count = len(self.near)
        needed, covered = 0, 0
        for length in range(self.graph.longest, 0, -1):
            within = reach >> count * (length - 1) & goals
            needed += (within & ~covered).bit_count() * (self.unit // length)
            covered |= within
        if covered != goals or self._stranded(free, open_nodes):
            return None
        return -(-needed // self.unit)

    def _stranded(self, free: int, open_nodes: int) -> bool:
        """Whether more free nodes have a single way to them than the tour has ends left."""
        once = twice = 0
        rest = open_nodes
        while rest:
            low = rest & -rest
            near = self.near[low.bit_length() - 1]
            twice |= once & near
            once |= near
            rest ^= low
        return (free & ~twice).bit_count() > (0 if self.closed else 1)
