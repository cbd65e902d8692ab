"""What changes from frame to frame: the smallest rectangle around it, and in it what stays as it was."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from timelaw.progress import Progress
from timelaw.report.animation.film import COLOURS, Film, Pixels

CLEAR = COLOURS  # the index of a pixel that stays as it was


@dataclass(frozen=True)
class Change:
    """Indices of a palette (h, w) from a corner `left`, `top` on, and how long they stay [ms]."""

    left: int
    top: int
    pixels: Pixels
    delay: int


def list_changes(film: Film, progress: Progress | None = None, grid: int = 1) -> Iterator[Change]:
    """One for each frame, the first of them whole; corners are multiples of `grid`."""
    before: Pixels | None = None
    for pixels, delay in zip(film.reduce_frames(progress), film.delays, strict=True):
        if before is None:
            yield Change(0, 0, pixels, delay)
        else:
            yield _compare(before, pixels, delay, grid)
        before = pixels


def _compare(before: Pixels, now: Pixels, delay: int, grid: int) -> Change:
    changed = before != now
    rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
    if not len(rows):
        return Change(0, 0, np.full((1, 1), CLEAR, dtype=np.uint8), delay)
    top, left = (int(k[0]) // grid * grid for k in (rows, columns))
    part = (slice(top, int(rows[-1]) + 1), slice(left, int(columns[-1]) + 1))
    return Change(left, top, np.where(changed[part], now[part], CLEAR).astype(np.uint8), delay)
