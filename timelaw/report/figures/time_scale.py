"""Time along a picture: seconds, but rest that would squeeze the moves is drawn shorter than it is."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from timelaw.motion import Segment
from timelaw.numerics.array import Array
from timelaw.report.figures.style import MARGINS, MUTED, SIZE, Canvas, measure_text
from timelaw.report.numbers import write_number

MOST_REST = 0.5  # of the time in motion; where the body rests longer in all, rest is drawn shorter
DRAWN_REST = 0.25  # of the time in motion, all rest together, where it is drawn shorter
LONGEST_REST = 0.6  # of the mean leg, one rest that is drawn shorter
GAP = 5.0  # points between two labels
MARKED = 40  # rests; more have no break mark of their own


class TimeScale:
    """Where instants of some segments stand, in drawn seconds from the start of the first."""

    def __init__(self, segments: Sequence[Segment]) -> None:
        self.segments = segments
        self.times = np.array([segments[0].start_time, *(s.end_time for s in segments)])
        moving = np.array([s.moves for s in segments])
        long = np.diff(self.times)
        drawn = np.where(moving, long, np.minimum(long, self._find_longest(long, moving)))
        self.places = np.concatenate([[0.0], np.cumsum(drawn)])
        self.shortened = tuple(int(k) for k in np.flatnonzero(~moving & (drawn < long)))

    @staticmethod
    def _find_longest(long: Array, moving: NDArray[np.bool_]) -> float:
        """The most [s] that one rest takes in the picture."""
        motion, rest = float(np.sum(long[moving])), float(np.sum(long[~moving]))
        if not motion or rest <= MOST_REST * motion:
            return float(np.max(long))
        legs, rests = np.count_nonzero(moving), np.count_nonzero(~moving)
        return min(DRAWN_REST * motion / rests, LONGEST_REST * motion / legs)

    @property
    def end(self) -> float:
        """Where the last instant stands."""
        return float(self.places[-1])

    def __call__(self, times: ArrayLike) -> Array:
        """Places of instants [s]."""
        return np.asarray(np.interp(np.asarray(times, dtype=float), self.times, self.places))

    def mark(self, ax: Any, canvas: Canvas, end: float) -> None:
        """Ticks and their labels on the lower edge of a panel that goes to `end`, and marks of breaks."""
        if self.shortened:
            starts = [s.start_time for s in self.segments if s.moves]
            instants = np.array([*starts, self.times[-1]])
            set_labels(ax, canvas, [write_number(t, 4) for t in instants], self(instants), end)
        else:
            mark_seconds(ax, canvas, float(self.times[0]), end)
        self._break(ax)

    def _break(self, ax: Any) -> None:
        """Two strokes through the axis in every rest that is drawn shorter."""
        if not 0 < len(self.shortened) <= MARKED:
            return
        middles = [(self.places[k] + self.places[k + 1]) / 2 for k in self.shortened]
        strokes = [[(-0.6, -1), (0.0, 1)], [(0.0, -1), (0.6, 1)]]
        from matplotlib.path import Path

        marker = Path([p for s in strokes for p in s], [Path.MOVETO, Path.LINETO] * 2)
        ax.plot(
            middles,
            np.zeros(len(middles)),
            marker=marker,
            markersize=8,
            markeredgewidth=0.9,
            color=MUTED,
            linestyle="none",
            transform=ax.get_xaxis_transform(),
            clip_on=False,
            zorder=9,
        )


def mark_seconds(ax: Any, canvas: Canvas, first: float, end: float) -> None:
    """Even instants from `first` on, on an axis that begins there and is so many seconds long."""
    from matplotlib.ticker import MaxNLocator

    instants = np.array(MaxNLocator(canvas.ticks).tick_values(first, first + end))
    instants = instants[(instants >= first) & (instants <= first + end)]
    set_labels(ax, canvas, [write_number(t, 6) for t in instants], instants - first, end)


def set_labels(ax: Any, canvas: Canvas, labels: Sequence[str], places: Array, end: float) -> None:
    """Ticks where their labels can stand."""
    kept = choose_labels(labels, places, end, canvas)
    ax.set_xticks(places[kept], [labels[k] for k in kept])


def choose_labels(labels: Sequence[str], places: Array, end: float, canvas: Canvas) -> list[int]:
    """Which of the labels, in order along a panel that goes to `end`, can stand without touching."""
    points = (canvas.width - sum(MARGINS)) * 72
    kept: list[int] = []
    free = -MARGINS[0] * 72
    for index, (label, place) in enumerate(zip(labels, places, strict=True)):
        middle, half = float(place) / end * points, measure_text(label, SIZE) / 2
        if middle - half >= free and middle + half <= points + MARGINS[1] * 72:
            kept.append(index)
            free = middle + half + GAP
    return kept
