"""Instants of a law: enough of them for a smooth line, and steps of time that are round numbers."""

from math import floor, log10

import numpy as np

from timelaw.errors import InputError
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array

FINE, COARSE = 48, 12  # points of a leg, in a motion of few legs and of very many
MOST_POINTS = 6000  # of a line that is still a small file
MOST_LEGS = MOST_POINTS // COARSE  # that one line shows
DRAWN = range(4)  # q, ω, α, jerk
HUGE = 1e100  # sums of squares of what is less stay finite
MARKS = 40  # about as many marks of time as can be told apart along a motion


def sample_times(law: QuaternionLaw) -> Array:
    """Times (m,) from start to end [s]: both ends of every segment, and some between them."""
    legs = max(len(law.legs), 1)
    count = int(np.clip(MOST_POINTS // legs, COARSE, FINE))
    parts = [
        segment.start_time
        + segment.duration * np.linspace(0.0, 1.0, count if segment.moves else 1, endpoint=False)
        for segment in law.segments
    ]
    return np.append(np.concatenate(parts), law.duration)


def find_last_shown(law: QuaternionLaw) -> float:
    """The instant [s] up to which lines are drawn: of a motion of very many legs the end of the first 500."""
    numbers = [number for number, segment in enumerate(law.segments, 1) if segment.moves]
    return float(law.times[numbers[MOST_LEGS - 1]]) if len(numbers) > MOST_LEGS else law.duration


def count_shown(law: QuaternionLaw) -> str:
    """How many legs are drawn, in words."""
    count = len(law.legs)
    return f"the first {MOST_LEGS} of {count} legs" if count > MOST_LEGS else f"{count} legs"


def refuse_undefined(law: QuaternionLaw) -> None:
    """Say where a law that was read from a file has no orientation, place or rates that could be drawn.

    Raises:
        InputError: it has none at some instant that is looked at.
    """
    times = sample_times(law)
    with np.errstate(all="ignore"):
        values = [law(times, order) for order in DRAWN] + ([law.place(times)] if law.travels else [])
    for value in values:
        wrong = ~np.all(np.abs(value) < HUGE, axis=-1)  # what is no number is not less
        if np.any(wrong):
            where = f"{law.name}: nothing can be drawn at t = {times[np.argmax(wrong)]:.6g} s"
            raise InputError(f"{where}; timelaw verify says what is wrong")


def choose_step(duration: float, count: int = MARKS) -> float:
    """1, 2 or 5 times a power of ten [s], of which about so many fill the time."""
    least = duration / count
    power = 10.0 ** floor(log10(least))
    return next(step for part in (1, 2, 5, 10) if (step := part * power) >= least * (1 - 1e-9))


def list_marks(law: QuaternionLaw) -> tuple[float, Array]:
    """A step [s], and the times at all its multiples up to the end."""
    step = choose_step(law.duration)
    count = int(law.duration / step * (1 + 1e-12))
    return step, np.linspace(0.0, count * step, count + 1).clip(max=law.duration)
