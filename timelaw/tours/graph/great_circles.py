"""Great circles through a set, and how long a run over the nodes still free on one can be."""

from dataclasses import dataclass
from functools import cached_property

from timelaw.tours.graph.minimal_legs import MinimalLegs


@dataclass(frozen=True)
class GreatCircle:
    """Nodes in a row on a great circle, `ring` if the last is followed by the first."""

    nodes: tuple[int, ...]
    ring: bool

    @cached_property
    def mask(self) -> int:
        """The nodes as bits."""
        return sum(1 << node for node in self.nodes)

    def reach(self, free: int, count: int) -> int:
        """The longest run over free nodes that visits each: node v by l legs is bit `count` (l - 1) + v."""
        found = 0
        for row in self._rows(free):
            for place in row:
                if len(row) > 1:
                    found |= 1 << count * (len(row) - 2) + self.nodes[place]
        return found

    def _rows(self, free: int) -> list[list[int]]:
        """Free places in a row, the row over the end of a ring as one."""
        rows: list[list[int]] = [[]]
        for place, node in enumerate(self.nodes):
            if free >> node & 1:
                rows[-1].append(place)
            elif rows[-1]:
                rows.append([])
        if self.ring and len(rows) > 1 and free >> self.nodes[0] & 1:
            rows[0] = rows.pop() + rows[0]
        return rows


def list_circles(graph: MinimalLegs) -> list[GreatCircle]:
    """All circles, or parts of one, that lead from node to node by minimal legs; each once."""
    found: dict[int, GreatCircle] = {}
    led_to = {(j, k) for (_, j), k in graph.onward.items()}
    for start, nearest in enumerate(graph.neighbours):
        for second in nearest:
            nodes = (start, *graph.line(start, second))
            ring = graph.onward.get((nodes[-2], nodes[-1])) == start
            if ring or (start, second) not in led_to:  # otherwise a part of a line that begins earlier
                circle = GreatCircle(nodes, ring)
                found.setdefault(circle.mask, circle)
    return list(found.values())
