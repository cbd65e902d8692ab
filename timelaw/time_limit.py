"""How long the work may take: looked at between solutions, and by the solver between its steps.

Where there is no limit nothing is ever late, and nothing depends on a clock.
"""

import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import inf
from types import FrameType

from timelaw.errors import InfeasibleError

LARGEST_PART = 0.5  # of the limit, that may be set aside
AGAIN = 0.1  # seconds after which it rings again: what it raises may be swallowed, in a destructor perhaps
LEAST = 1e-3  # seconds; a timer of none would never ring


@dataclass
class _State:
    """On the clock of `time.monotonic`: when the time is over, and when no more solving may begin."""

    begun: float = -inf
    over: float = inf
    late: float = inf


_state = _State()


@contextmanager
def limit_time(seconds: float | None, begun: float | None = None) -> Iterator[None]:
    """Inside, work is late `seconds` after `begun` (by default now); never if that is None."""
    if seconds is not None:
        _state.begun = time.monotonic() if begun is None else begun
        _state.over = _state.late = _state.begun + seconds
    try:
        yield
    finally:
        _state.begun, _state.over, _state.late = -inf, inf, inf


def is_late() -> bool:
    """Whether to come to an end with what there is."""
    return _state.late < inf and time.monotonic() > _state.late


def set_aside(seconds: float) -> None:
    """Be late that much earlier, but keep a fair part of the limit: for what comes after the solving."""
    if _state.over < inf:
        _state.late = _state.over - min(seconds, LARGEST_PART * (_state.over - _state.begun))


@contextmanager
def refuse_when_over(message: str) -> Iterator[None]:
    """End what runs inside when the time is over: for work without which there is no result at all.

    Raises:
        InfeasibleError: with this message. (On systems without timers only after the work.)
    """
    if _state.over == inf:
        yield
        return

    def refuse(_number: int = 0, _frame: FrameType | None = None) -> None:
        raise InfeasibleError(message)

    rings = hasattr(signal, "setitimer")
    before = signal.signal(signal.SIGALRM, refuse) if rings else None
    try:
        if rings:
            signal.setitimer(signal.ITIMER_REAL, max(_state.over - time.monotonic(), LEAST), AGAIN)
        yield
        if time.monotonic() > _state.over:
            refuse()
    finally:
        if rings:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, before)
