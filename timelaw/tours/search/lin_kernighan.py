"""A closed tour improved leg by leg (Lin & Kernighan 1973), and kicked out of where that ends.

A leg t1-t2 is taken out, a cheaper one t2-t3 put in, a leg t3-t4 taken out, and so on as long as more is
saved than spent; closing up to t1 gives a tour again. Two such exchanges are looked at together (as in
Helsgaun 2000), over all that give a tour; from the best of those that do not save, the chain goes on.
From where nothing helps two short stretches next to each other are exchanged (a double bridge, Martin, Otto
& Felten 1991), the places around are improved again, and what is longer is undone.
"""

from collections.abc import Iterable, Sequence
from math import inf
from random import Random
from typing import NamedTuple

from timelaw.tours.search.costs import Leg

DEPTH = 12  # exchanges of a chain, of up to three legs each
STRETCH = 10  # nodes exchanged in a kick, at most
GAIN = 1e-9  # of the mean cost of near legs; smaller gains are rounding

Near = Sequence[Sequence[tuple[int, float]]]
Exchange = tuple[int, int, int, int]
Added = tuple[tuple[int, int], ...]


class Found(NamedTuple):
    """What an exchange saves when it is closed and while it is open, how it is made, and what it puts in.

    Its last node is the next t2.
    """

    closed: float
    open: float
    steps: tuple[Exchange, ...]
    added: Added
    last: int


class Cycle:
    """A closed tour of N ≥ 5 nodes; `near` are those to which legs are tried, with costs, cheapest first.

    Kicks that cost more than `most` are not tried.
    """

    def __init__(self, nodes: Sequence[int], cost: Leg, near: Near, most: float = inf) -> None:
        self.count, self.nodes, self.cost, self.near = len(nodes), list(nodes), cost, near
        self.most = most
        self.place = [0] * self.count
        for index, node in enumerate(self.nodes):
            self.place[node] = index
        costs = [abs(leg) for row in near for _, leg in row]
        self.gain = GAIN * sum(costs) / max(len(costs), 1)
        self._reversed: list[tuple[int, int]] = []

    def improve(self, nodes: Iterable[int]) -> float:
        """Exchange legs at these nodes and those they touch until nothing is saved; what is saved in all."""
        waiting = list(nodes)
        queued, total = set(waiting), 0.0
        while waiting:
            node = waiting.pop()
            queued.discard(node)
            while (saved := self._improve_at(node)) is not None:
                total += saved[0]
                fresh = [n for n in saved[1] if n not in queued]
                queued.update(fresh)
                waiting += fresh
        return total

    def kick(self, random: Random) -> None:
        """Exchange two stretches side by side, improve around them, and keep what is not longer."""
        nodes, cost, n = self.nodes, self.cost, self.count
        self._reversed.clear()
        most = max(1, min(STRETCH, (n - 2) // 2))
        one, two = 1 + int(random.random() * most), 1 + int(random.random() * most)
        first = int(random.random() * n)
        places = [(first + k) % n for k in range(one + two + 2)]
        row = [nodes[p] for p in places]
        a, b, c, e, f, g = row[0], row[1], row[one], row[one + 1], row[one + two], row[-1]
        longer = cost(a, e) + cost(f, b) + cost(c, g) - cost(a, b) - cost(c, e) - cost(f, g)
        if longer > self.most:
            return
        self._put(places[1:-1], row[one + 1 : -1] + row[1 : one + 1])
        if longer - self.improve((a, b, c, e, f, g)) > 0:
            self._undo(0)
            self._put(places, row)

    def _put(self, places: Sequence[int], nodes: Sequence[int]) -> None:
        for place, node in zip(places, nodes, strict=True):
            self.nodes[place] = node
            self.place[node] = place

    def _improve_at(self, t1: int) -> tuple[float, set[int]] | None:
        """A chain of exchanges that saves, beginning with either leg of t1, and the nodes it touches."""
        nodes, place = self.nodes, self.place
        for t2 in (nodes[place[t1] + 1 - self.count], nodes[place[t1] - 1]):
            mark, last, left = len(self._reversed), t2, self.cost(t1, t2)
            added: Added = ()
            for _ in range(DEPTH):
                found = self._exchange(t1, last, left, added)
                if found is None:
                    break
                for step in found.steps:
                    self._replace(*step)
                added += found.added
                if found.closed > self.gain:
                    return found.closed, {t1, t2, found.last, *(node for leg in added for node in leg)}
                last, left = found.last, found.open
            self._undo(mark)
        return None

    def _exchange(self, t1: int, t2: int, saved: float, added: Added) -> Found | None:
        """The first exchange from t1-t2 that saves, or else the one that leaves most to spend, if any."""
        nodes, place, cost, n = self.nodes, self.place, self.cost, self.count
        at = place[t2]
        ahead = nodes[at - 1] == t1
        best = None
        for t3, leg in self.near[t2]:
            left = saved - leg
            if left <= self.gain:
                break
            if t3 == t1:
                continue
            p3 = place[t3]
            before, after = nodes[p3 - 1], nodes[p3 + 1 - n]
            if not ahead:
                before, after = after, before
            if before != t2 and not (added and _holds(added, before, t3)):
                more = left + cost(t3, before)
                closed = more - cost(before, t1)
                if closed > self.gain:
                    return Found(closed, more, ((t1, t2, before, t3),), ((t2, t3),), before)
                best = self._go_on(t1, t2, t3, before, more, added, best)
                if best is not None and best.closed > self.gain:
                    return best
            if not (added and _holds(added, after, t3)):
                best = self._go_round(t1, t2, t3, after, left + cost(t3, after), added, best)
                if best is not None and best.closed > self.gain:
                    return best
        return best

    def _go_on(
        self, t1: int, t2: int, t3: int, t4: int, left: float, added: Added, best: Found | None
    ) -> Found | None:
        """The best second leg t4-t5, where t1-t4 … t2-t3 … is a tour already."""
        nodes, place, cost, n = self.nodes, self.place, self.cost, self.count
        at, most = place[t2], self.gain if best is None else best.open
        ahead = nodes[at - 1] == t1
        reach = (place[t3] - at if ahead else at - place[t3]) % n
        for t5, leg in self.near[t4]:
            spent = left - leg
            if spent <= self.gain:
                break
            if t5 in (t1, t3):
                continue
            p5 = place[t5]
            behind = (p5 - at if ahead else at - p5) % n > reach
            t6 = nodes[p5 - 1] if behind == ahead else nodes[p5 + 1 - n]
            if t6 == t4 or (added and _holds(added, t5, t6)):
                continue
            more = spent + cost(t5, t6)
            closed = more - cost(t6, t1)
            if more > most or closed > self.gain:
                steps = ((t1, t2, t4, t3), (t1, t4, t6, t5))
                best, most = Found(closed, more, steps, ((t2, t3), (t4, t5)), t6), more
                if closed > self.gain:
                    break
        return best

    def _go_round(
        self, t1: int, t2: int, t3: int, t4: int, left: float, added: Added, best: Found | None
    ) -> Found | None:
        """The best second leg t4-t5, where t2 … t3-t2 is a ring by itself, which t5-t6 opens."""
        nodes, place, cost, n = self.nodes, self.place, self.cost, self.count
        at, most = place[t2], self.gain if best is None else best.open
        ahead = nodes[at - 1] == t1
        reach = (place[t3] - at if ahead else at - place[t3]) % n
        for t5, leg in self.near[t4]:
            spent = left - leg
            if spent <= self.gain:
                break
            p5 = place[t5]
            if (p5 - at if ahead else at - p5) % n >= reach:
                continue
            for onward in (True, False):
                if not onward and t5 == t2:
                    break
                t6 = nodes[p5 + 1 - n] if onward == ahead else nodes[p5 - 1]
                if added and _holds(added, t5, t6):
                    continue
                more = spent + cost(t5, t6)
                closed = more - cost(t6, t1)
                if more > most or closed > self.gain:
                    steps: tuple[Exchange, ...] = (
                        ((t1, t2, t3, t4), (t1, t3, t6, t5), (t3, t5, t2, t4))
                        if onward
                        else ((t1, t2, t6, t5), (t2, t5, t3, t4))
                    )
                    best, most = Found(closed, more, steps, ((t2, t3), (t4, t5)), t6), more
                    if closed > self.gain:
                        return best
        return best

    def _replace(self, a: int, b: int, c: int, e: int) -> None:
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
        self._reversed.append((i, j))
        if i <= j:
            turned = nodes[i : j + 1]
            turned.reverse()
            nodes[i : j + 1] = turned
            for node in turned:
                place[node] = i
                i += 1
            return
        for _ in range(length // 2):
            a, b = nodes[i], nodes[j]
            nodes[i], nodes[j], place[b], place[a] = b, a, i, j
            i, j = (i + 1) % n, (j - 1) % n

    def _undo(self, mark: int) -> None:
        """Take back all reversals but the first `mark`."""
        done = self._reversed[mark:]
        for i, j in reversed(done):
            self._reverse(i, j)
        del self._reversed[mark:]


def _holds(added: Added, i: int, j: int) -> bool:
    """Whether a leg is one of those that were put in."""
    return (i, j) in added or (j, i) in added
