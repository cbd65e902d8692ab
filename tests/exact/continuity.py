"""Continuity: jumps of the rates at breaks and nodes, in parts of what they are judged by."""

from collections.abc import Iterator
from dataclasses import dataclass

from flint import arb

from tests.exact.limits import LIMIT_ORDERS, RATE_ORDERS
from tests.exact.motion import Motion
from tests.exact.rational import largest, norm, read, surely_exceeds, surely_keeps
from tests.exact.segments import ORDERS, Segment

JUMP = 1e-9  # of the scale of that order
FINE = 500  # parts of a mean leg, over which rounded numbers show no rate
SPACING = 2.0**-50  # four of doubles near one
LOOSE = 1000  # times the sustained rate
SHORTEST_SHARE = 1e-3  # of the mean duration; a shorter segment's sustained rate is spread over that

Jumps = dict[int, list]  # by order a vector (3,)


@dataclass(frozen=True)
class Break:
    """A place where rates may jump: by order each jump in parts of its scale; `segments` touch it.

    `node` is the number of the node, or none for a break inside a segment.
    """

    segments: tuple[Segment, ...]
    parts: dict[int, arb]
    node: int | None

    def least_class(self) -> int:
        """Leading rates that surely do not jump: the class is not lower."""
        return _count(surely_keeps(self.parts[k], JUMP) for k in ORDERS)

    def greatest_class(self) -> int:
        """Leading rates that do not surely jump: the class is not higher."""
        return _count(not surely_exceeds(self.parts[k], JUMP) for k in ORDERS)


def _count(kept: Iterator[bool]) -> int:
    count = 0
    for one in kept:
        if not one:
            break
        count += 1
    return count


def list_breaks(motion: Motion) -> list[Break]:
    """All breaks inside segments, then all nodes, the first and last instant among them."""
    sustained = measure_sustained_rates(motion)
    found = []
    for segment in motion.moving:
        for each in zip(*(segment.jumps(k) for k in ORDERS), strict=True):
            jumps = dict(zip(ORDERS, each, strict=True))
            found.append(Break((segment,), _relate(motion, (segment,), jumps, sustained), None))
    for index in range(len(motion.segments) + 1):
        sides = motion.segments[max(index - 1, 0) : index + 1]
        jumps = {k: _jump_at_node(motion, index, k) for k in ORDERS}
        found.append(Break(tuple(sides), _relate(motion, tuple(sides), jumps, sustained), index))
    return found


def _jump_at_node(motion: Motion, index: int, order: int) -> list[arb]:
    segments = motion.segments
    before = segments[index - 1].last(order) if index else motion.outside("before", order)
    after = segments[index].first(order) if index < len(segments) else motion.outside("after", order)
    return [b - a for a, b in zip(before, after, strict=True)]


def _relate(
    motion: Motion, sides: tuple[Segment, ...], jumps: Jumps, sustained: dict[int, arb]
) -> dict[int, arb]:
    """Each jump in parts of its scale, the looser one where two segments meet."""
    parts = {}
    for k in ORDERS:
        each = [_divide(motion, side, k, jumps[k], sustained[k]) for side in sides]
        parts[k] = each[0] if len(each) == 1 else each[0].min(each[1])
    return parts


def count_parts(segment: Segment) -> int:
    """2 n p of p pieces of degree n, at most 500; 0 for what is no curve."""
    if not segment.curved:
        return 0
    return min(2 * len(segment.pieces) * max(len(piece.control) - 1 for piece in segment.pieces), FINE)


def _divide(motion: Motion, segment: Segment, order: int, jump: list, sustained: arb) -> arb:
    """In parts of the tightest limit of that order on a segment, else of the motion's sustained rate.

    A limit that is a thousand times above that says nothing about jumps. What rounded quaternions show is none.
    """
    name = next(name for name, k in RATE_ORDERS.items() if k == order)
    given = [limits[name] for limits in (motion.limits, segment.limits) if name in limits]
    floor = arb(SPACING) * arb(count_parts(segment) / motion.mean_time) ** order / arb(JUMP)
    size, kept = norm(jump), sustained.max(floor)
    if size.is_zero():
        return arb(0)
    if given:
        own = largest([_divide_by_bounds(jump, bounds, floor) for bounds in given])
        return own if kept.is_zero() else own.max(size / (LOOSE * sustained).max(floor))
    return size / kept if not kept.is_zero() else arb.pos_inf()


def _divide_by_bounds(jump: list, bounds: float | list[float], floor: arb) -> arb:
    if isinstance(bounds, list):
        return largest([abs(arb(x)) / arb(read(b)).max(floor) for x, b in zip(jump, bounds, strict=True)])
    return norm(jump) / arb(read(bounds)).max(floor)


def measure_sustained_rates(motion: Motion) -> dict[int, arb]:
    """M_k by order: the largest rate that a segment keeps up, no less than the greatest speed makes likely."""
    moving = motion.moving
    if not moving:
        return dict.fromkeys(ORDERS, arb(0))
    mean = motion.mean_time
    speed = largest([segment.size(1) for segment in moving])
    rates = {}
    for k in ORDERS:
        kept = [
            segment.sum_rate(k) / max(segment.duration, mean * read(SHORTEST_SHARE)) for segment in moving
        ]
        rates[k] = largest([*kept, speed / motion.end ** (k - 1)])
    return rates


def find_jumps(motion: Motion, breaks: list[Break]) -> list[str]:
    """P6: a class that is not reached, and limits of rates under which a lower rate jumps."""
    found = []
    asked = motion.document.get("continuity", 0)
    reached = min(one.greatest_class() for one in breaks)
    if reached < asked:
        found.append(f"P6 the motion is C{reached}, C{asked} was asked for")
    for one in breaks:
        names = [*motion.limits, *(name for segment in one.segments for name in segment.limits)]
        needed = max((LIMIT_ORDERS.get(name, 0) for name in names), default=0) - 1
        if one.greatest_class() < needed:
            place = f"node {one.node}" if one.node is not None else f"a break in {one.segments[0].place}"
            found.append(
                f"P6 the rate {one.greatest_class() + 1} jumps at {place} under a limit of order {needed + 1}"
            )
    return found
