"""The way of the body's origin: gaps, and jumps of its rates in parts of what they are judged by."""

from collections.abc import Iterator
from functools import cached_property
from itertools import pairwise
from typing import Any

from flint import arb, fmpq

from tests.exact.continuity import FINE, JUMP, LOOSE, SHORTEST_SHARE, SPACING, Break
from tests.exact.curve_limits import LINEAR_ORDERS
from tests.exact.motion import Motion
from tests.exact.origins import NORM, ORDERS
from tests.exact.rational import largest, norm, read, read_all, show, surely_exceeds
from tests.exact.rational_segment import MARGIN
from tests.exact.segments import Segment

GAP = 1e-9  # of the farthest place

Ends = tuple[list, list]  # the place and its derivatives before and after


class Way:
    """The origin's way of a motion in which it moves: all its breaks, and what they are judged by."""

    def __init__(self, motion: Motion):
        self.motion = motion
        origins = [origin for segment in motion.moving for origin in segment.origins]
        points = [norm(_rest(s)[0]) for s in motion.segments if not s.moves]
        self.farthest = largest([*points, *(origin.measure(0, NORM) for origin in origins)])
        self._sustained = self._sum_means()

    def list_meetings(self) -> Iterator[tuple[tuple[Segment, ...], Ends, int | None]]:
        """Segments, what is on both sides, and the number of the node, or none inside a segment."""
        for segment in self.motion.moving:
            for a, b in pairwise(segment.origins):
                yield (segment,), (a.last, b.first), None
        segments = self.motion.segments
        for index in range(len(segments) + 1):
            sides = tuple(segments[max(index - 1, 0) : index + 1])
            before = _end(segments[index - 1]) if index else _still(_start(segments[0]))
            after = _start(segments[index]) if index < len(segments) else _still(_end(segments[-1]))
            if self.motion.periodic:
                before = before if index else [before[0], *_end(segments[-1])[1:]]
                after = after if index < len(segments) else _start(segments[0])
            yield sides, (before, after), index

    @cached_property
    def breaks(self) -> list[Break]:
        """Each with its jumps by order in parts of their scales."""
        found = []
        for sides, (before, after), node in self.list_meetings():
            parts = {k: self._relate(sides, k, _subtract(after[k], before[k])) for k in ORDERS}
            found.append(Break(sides, parts, node))
        return found

    def _relate(self, sides: tuple[Segment, ...], order: int, jump: list) -> arb:
        """In parts of the looser scale where two segments meet; never less than what rounding shows."""
        if norm(jump).is_zero():
            return arb(0)
        floor = self._floor(order)
        each = [self._divide(side, order, jump, floor) for side in sides]
        return each[0] if len(each) == 1 else each[0].min(each[1])

    def _divide(self, segment: Segment, order: int, jump: list, floor: arb) -> arb:
        kept = self._sustained[order].max(floor)
        names = [name for name, k in LINEAR_ORDERS.items() if k == order]
        given = [
            limits[name]
            for limits in (self.motion.limits, segment.limits)
            for name in names
            if name in limits
        ]
        if not given:
            return norm(jump) / kept
        parts = [norm(jump) / (LOOSE * kept)]
        for bounds in given:
            own = bounds if isinstance(bounds, list) else None
            pairs = zip(jump, own, strict=True) if own else [(norm(jump), bounds)]
            parts += [abs(arb(x)) / arb(read(bound)).max(floor) for x, bound in pairs]
        return largest(parts)

    def _floor(self, order: int) -> arb:
        mean = self.motion.mean_time
        return 3 * arb(SPACING) * self.farthest * arb(FINE / mean) ** order / arb(JUMP)

    def _sum_means(self) -> dict[int, arb]:
        """The largest mean of each rate over a leg; a brief leg counts for as much as a thousandth of the mean."""
        moving = self.motion.moving
        mean = self.motion.mean_time
        return {
            k: largest([_sum_rate(s, k) / max(s.duration, mean * read(SHORTEST_SHARE)) for s in moving])
            for k in ORDERS
        }

    def gross(self, order: int) -> float:
        """What a rate is at most if nothing cancels."""
        return max(origin.gross(order) for segment in self.motion.moving for origin in segment.origins)

    def find_gaps(self) -> list[str]:
        """P3: places that are apart though they should be one."""
        found = []
        for sides, (before, after), node in self.list_meetings():
            gap = norm(_subtract(after[0], before[0]))
            if surely_exceeds(gap, 0.0) and surely_exceeds(gap / self.farthest, GAP):
                place = f"node {node}" if node is not None else f"a break in {sides[0].place}"
                found.append(f"P3 the origin's way has a gap of {show(gap)} at {place}")
        return found

    def find_jumps(self) -> list[str]:
        """P6: a class that is not reached, and limits of rates under which a lower rate jumps."""
        found = []
        asked = self.motion.document.get("continuity", 0)
        reached = min(one.greatest_class() for one in self.breaks)
        if reached < asked:
            found.append(f"P6 the origin's way is C{reached}, C{asked} was asked for")
        names = [*self.motion.limits, *(name for segment in self.motion.segments for name in segment.limits)]
        needed = max((LINEAR_ORDERS.get(name, 0) for name in names), default=0) - 1
        if reached < needed:
            found.append(f"P6 the origin's rate {reached + 1} jumps under a limit of order {needed + 1}")
        return found


def _sum_rate(segment: Segment, order: int) -> arb:
    """Σ h · mean of |rate|, and a hundredth more for who measures it in doubles."""
    pairs = zip(segment.pieces, segment.origins, strict=True)
    return sum((piece.duration * origin.means[order - 1] for piece, origin in pairs), arb(0)) * (
        1 + arb(MARGIN)
    )


def _rest(segment: Segment) -> list[Any]:
    """The place of a dwell, and no rates."""
    return _still([read_all(segment.data["point"])])


def _still(ends: list[list]) -> list[list]:
    return [ends[0], *([[fmpq(0)] * 3] * len(ORDERS))]


def _start(segment: Segment) -> list[list]:
    return segment.origins[0].first if segment.moves else _rest(segment)


def _end(segment: Segment) -> list[list]:
    return segment.origins[-1].last if segment.moves else _rest(segment)


def _subtract(a: list, b: list) -> list:
    return [x - y for x, y in zip(a, b, strict=True)]
