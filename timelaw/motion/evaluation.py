"""Values of a motion at many instants: a few thousand at a time, all orders in one pass.

Instants in order are cut where pieces meet, and a long run on one piece is evaluated by its own numbers
alone; short runs and instants in no order take the numbers of the piece of each.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Protocol

import numpy as np

from timelaw.easing.profile import Side, locate
from timelaw.motion.arc_stack import ArcStack
from timelaw.motion.dwell_stack import DwellStack
from timelaw.motion.rational_stack import RationalStack
from timelaw.motion.segment import Segment, group_by_kind
from timelaw.numerics.array import Array
from timelaw.numerics.chebyshev import Index, Points, Rows, take_rows

BLOCK = 16384  # instants; arrays of as many doubles stay near the processor
CUT = 32 * BLOCK  # instants that are cut together
LONG = 1024  # instants on one piece for which its own passes cost less than numbers for each


class SegmentStack(Protocol):
    """The pieces of segments of one kind, made ready for values at many points."""

    @property
    def durations(self) -> Array:
        """How long the pieces last (N,) [s]."""
        ...

    def fill(self, rows: Rows, points: Points, values: Mapping[int, Array]) -> None:
        """Write q (m, 4) and rates (m, 3), by order, at points of one row, or of the row of each."""
        ...


STACKS: dict[str, Callable[[Sequence[Any]], SegmentStack]] = {
    "arc": ArcStack.stack,
    "dwell": DwellStack.stack,
    "rational": RationalStack.stack,
}


@dataclass(frozen=True)
class PieceTable:
    """The N pieces of a motion: `times` (N+1,) where they meet; each is a `row` (N,) of a `stack` (N,).

    `clock` (5, N): 4u = (t - start - offset)/quarter, start and offset those of the segment and of the piece
    in it, a quarter of its duration; then its first and its last instant.
    """

    times: Array
    clock: Array
    stack: Index
    row: Index
    stacks: tuple[SegmentStack, ...]

    @classmethod
    def of(cls, segments: Sequence[Segment]) -> "PieceTable":
        """All pieces of segments that follow each other."""
        counts = [len(segment.breaks) - 1 for segment in segments]
        number = np.repeat(np.arange(len(segments)), counts)
        stack, row, durations = np.empty_like(number), np.empty_like(number), np.empty(len(number))
        stacks: list[SegmentStack] = []
        for kind, numbers in group_by_kind(segments).items():
            stacks.append(STACKS[kind.kind]([segments[k] for k in numbers]))
            own = np.flatnonzero(np.isin(number, numbers))
            stack[own], row[own], durations[own] = len(stacks) - 1, np.arange(len(own)), stacks[-1].durations
        ends = [np.cumsum(own) for own in np.split(durations, np.cumsum(counts)[:-1])]
        # pieces fill their segment but for rounding, and may be shorter than times are told apart
        fill = np.array([s.duration / own[-1] for s, own in zip(segments, ends, strict=True)])[number]
        offset = np.concatenate([[0.0, *own[:-1]] for own in ends]) * fill
        starts = np.array([*(segment.start_time for segment in segments), segments[-1].end_time])
        times = np.append(np.minimum(starts[number] + offset, starts[number + 1]), starts[-1])
        clock = np.array([starts[number], offset, durations * fill / 4, times[:-1], times[1:]])
        return cls(times, clock, stack, row, tuple(stacks))

    def evaluate(self, t: Array, orders: Sequence[int], side: Side) -> dict[int, Array]:
        """Quaternions (m, 4) for order 0, rates (m, 3) for others at instants t (m,), by order.

        Raises:
            ValueError: t outside the motion.
        """
        values = {order: np.empty((len(t), 3 if order else 4)) for order in orders}
        for first in range(0, len(t), CUT):
            part = slice(first, first + CUT)
            for here, piece in self._cut(t[part], side):
                self._fill(t[part][here], piece, {k: value[part][here] for k, value in values.items()})
        return values

    def _cut(self, t: Array, side: Side) -> Iterator[tuple[slice, Rows]]:
        """Blocks, each with the piece that holds it, or the piece (m,) of each instant."""
        if np.all(t[1:] >= t[:-1]):
            first, last = locate(self.times, t[[0, -1]], side).tolist()
            if (last - first) * LONG < len(t):
                inner = self.times[first + 1 : last + 1]
                cuts = np.searchsorted(t, inner, "left" if side == "right" else "right").tolist()
                for k, (start, end) in enumerate(pairwise([0, *cuts, len(t)]), first):
                    yield from ((block, slice(k, k + 1)) for block in _list_blocks(start, end))
                return
        for block in _list_blocks(0, len(t)):
            yield block, locate(self.times, t[block], side)

    def _fill(self, t: Array, piece: Rows, values: Mapping[int, Array]) -> None:
        """Write what is wanted at instants (m,) of one piece, or of the piece of each."""
        points, stack, row = self._place(t, piece), self.stack[piece], self.row[piece]
        if isinstance(piece, slice):
            first = int(row[0])
            self.stacks[stack[0]].fill(slice(first, first + 1), points, values)
            return
        for number in np.unique(stack) if len(self.stacks) > 1 else (0,):
            here = np.flatnonzero(stack == number)
            if len(here) == len(t):
                self.stacks[number].fill(row, points, values)
                continue
            found = {order: np.empty((len(here), value.shape[1])) for order, value in values.items()}
            self.stacks[number].fill(row[here], points.take(here), found)
            for order, value in found.items():
                values[order][here] = value

    def _place(self, t: Array, piece: Rows) -> Points:
        """Where on their pieces the instants are."""
        start, offset, quarter, first, last = take_rows(self.clock, piece)
        twice = t - start
        twice -= offset
        twice /= quarter
        twice -= 2
        return Points.clip(twice, t <= first, t >= last)


def _list_blocks(start: int, end: int) -> Iterator[slice]:
    return (slice(first, min(first + BLOCK, end)) for first in range(start, end, BLOCK))
