"""Short tours of many nodes: iterated local search with 2-opt and Or-opt moves, the same one every time.

2-opt replaces two legs by turning round what is between them (Croes 1958), Or-opt moves up to
three nodes in a row to another place, either way round (Or 1976); only legs to near neighbours are
tried. From each local optimum two short stretches next to each other are exchanged (a double bridge, Martin,
Otto & Felten 1991), the places around are improved again, and what is longer is undone.
"""

from collections.abc import Iterable
from random import Random

import numpy as np

from timelaw.numerics.array import Array
from timelaw.progress import Progress

SEED = 20170112
NEIGHBOURS = 8  # nearest ones tried for new legs
STRETCH = 30  # nodes exchanged in a kick, at most
KICKS_PER_NODE, LEAST_KICKS, MOST_KICKS = 25, 10_000, 40_000
GAIN = 1e-9  # of the mean of all costs; smaller gains are rounding
SEGMENT = 3  # nodes an Or-opt move takes along


def find_short_cycle(costs: Array, progress: Progress | None = None) -> list[int]:
    """A short closed tour of all nodes under symmetric costs (N, N), N ≥ 5; node 0 first."""
    count = len(costs)
    tour = _Cycle(costs)
    tour.improve(range(count))
    random = Random(SEED)
    kicks = min(max(KICKS_PER_NODE * count, LEAST_KICKS), MOST_KICKS)
    for kick in range(kicks):
        tour.kick(random)
        if progress is not None and kick % 500 == 0:
            progress("tour", kick, kicks)
    start = tour.place[0]
    return tour.nodes[start:] + tour.nodes[:start]


class _Cycle:
    """A closed tour as a list of nodes and the place of each; legs are replaced by reversing stretches."""

    def __init__(self, costs: Array) -> None:
        self.count = len(costs)
        apart = costs + np.diag(np.full(self.count, np.inf))
        order = np.argsort(apart, axis=1, kind="stable")[:, : min(NEIGHBOURS, self.count - 1)]
        self.near: list[list[int]] = order.tolist()
        self.costs: list[list[float]] = costs.tolist()
        self.nodes = _nearest_first(apart)
        self.place = [0] * self.count
        for index, node in enumerate(self.nodes):
            self.place[node] = index
        self.gain = GAIN * float(np.mean(costs))

    def improve(self, nodes: Iterable[int]) -> float:
        """Apply improving moves at these nodes and those they touch until there is none; the gain."""
        waiting = list(nodes)
        queued, total = set(waiting), 0.0
        while waiting:
            node = waiting.pop()
            queued.discard(node)
            while (move := self._two_opt(node) or self._or_opt(node)) is not None:
                total += move[0]
                fresh = [n for n in move[1] if n not in queued]
                queued.update(fresh)
                waiting += fresh
        return total

    def kick(self, random: Random) -> None:
        """Exchange two stretches side by side, improve around them, and keep what is not longer."""
        nodes, place, d, n = self.nodes, self.place, self.costs, self.count
        kept = nodes[:], place[:]
        most = max(1, min(STRETCH, (n - 2) // 2))
        one, two = 1 + int(random.random() * most), 1 + int(random.random() * most)
        first = int(random.random() * n)
        places = [(first + k) % n for k in range(one + two + 2)]
        row = [nodes[p] for p in places]
        a, b, c, e, f, g = row[0], row[1], row[one], row[one + 1], row[one + two], row[-1]
        longer = d[a][e] + d[f][b] + d[c][g] - d[a][b] - d[c][e] - d[f][g]
        for p, node in zip(places[1:-1], row[one + 1 : -1] + row[1 : one + 1], strict=True):
            nodes[p] = node
            place[node] = p
        if longer - self.improve((a, b, c, e, f, g)) > 0:
            self.nodes, self.place = kept

    def _two_opt(self, a: int) -> tuple[float, tuple[int, ...]] | None:
        """Replace a's leg on one side and another leg by two shorter ones."""
        nodes, place, d, n = self.nodes, self.place, self.costs, self.count
        at = place[a]
        for ahead in (True, False):
            b = nodes[at + 1 - n] if ahead else nodes[at - 1]
            for c in self.near[a]:
                gain = d[a][b] - d[a][c]
                if gain <= self.gain:
                    break
                e = nodes[place[c] + 1 - n] if ahead else nodes[place[c] - 1]
                gain += d[c][e] - d[b][e]
                if gain > self.gain:
                    self._exchange(a, b, c, e)
                    return gain, (a, b, c, e)
        return None

    def _or_opt(self, a: int) -> tuple[float, tuple[int, ...]] | None:
        """Move up to three nodes, a at one end of them, to beside a near neighbour of a."""
        nodes, place, d, n = self.nodes, self.place, self.costs, self.count
        at = place[a]
        for ahead in (True, False):
            b = nodes[at + 1 - n] if ahead else nodes[at - 1]
            for more in range(SEGMENT):
                e = nodes[at - more] if ahead else nodes[at + more - n]
                f = nodes[(at - more - 1) % n] if ahead else nodes[(at + more + 1) % n]
                if f == b:
                    break
                saved = d[a][b] + d[e][f] - d[b][f]
                move = self._elsewhere((a, e, f, b), more, saved, ahead=ahead)
                if move is not None:
                    return move
        return None

    def _elsewhere(
        self, ends: tuple[int, int, int, int], more: int, saved: float, *, ahead: bool
    ) -> tuple[float, tuple[int, ...]] | None:
        """Put the stretch from e to a, between f and b, where a comes beside a near neighbour."""
        nodes, place, d, n = self.nodes, self.place, self.costs, self.count
        a, e, f, b = ends
        at = place[a]
        for c in self.near[a]:
            left = saved - d[a][c]
            if left <= self.gain:
                return None
            behind = (at - place[c] if ahead else place[c] - at) % n
            if behind <= more:
                continue  # c is one of those that move
            for after in (True, False):
                g = nodes[place[c] + 1 - n] if after else nodes[place[c] - 1]
                if g in (a, e):
                    continue
                gain = left + d[c][g] - d[e][g]
                if gain > self.gain:
                    toward = after == ahead
                    if n - behind < behind:  # the way to c past b is the shorter one
                        self._carry((f, e, a, b), *((c, g) if toward else (g, c)), turned=toward)
                    else:
                        self._carry((b, a, e, f), *((g, c) if toward else (c, g)), turned=toward)
                    return gain, (a, b, c, e, f, g)
        return None

    def _carry(self, stretch: tuple[int, int, int, int], c: int, g: int, *, turned: bool) -> None:
        """Make p s…t q…c g into p q…c t…s g, or into p q…c s…t g if not turned."""
        p, s, t, q = stretch
        self._exchange(p, s, c, g)
        self._exchange(p, c, q, t)
        if not turned:
            self._exchange(c, t, s, g)

    def _exchange(self, a: int, b: int, c: int, e: int) -> None:
        """Replace the legs a-b and c-e by a-c and b-e; b follows a as e follows c, either way round."""
        place = self.place
        if self.nodes[place[a] + 1 - self.count] == b:
            self._reverse(place[b], place[c])
        else:
            self._reverse(place[a], place[e])

    def _reverse(self, i: int, j: int) -> None:
        """Turn round the places i to j, or all others, whichever are fewer."""
        nodes, place, n = self.nodes, self.place, self.count
        length = (j - i) % n + 1
        if 2 * length > n:
            i, j, length = (j + 1) % n, (i - 1) % n, n - length
        if i <= j:
            turned = nodes[i : j + 1][::-1]
            nodes[i : j + 1] = turned
            for p, node in enumerate(turned, i):
                place[node] = p
            return
        for _ in range(length // 2):
            a, b = nodes[i], nodes[j]
            nodes[i], nodes[j], place[b], place[a] = b, a, i, j
            i, j = (i + 1) % n, (j - 1) % n


def _nearest_first(apart: Array) -> list[int]:
    """From node 0 always on to the nearest node that is left."""
    nodes, left = [0], np.ones(len(apart), dtype=bool)
    left[0] = False
    while len(nodes) < len(apart):
        row = np.where(left, apart[nodes[-1]], np.inf)
        node = int(np.argmin(row))
        nodes.append(node)
        left[node] = False
    return nodes
