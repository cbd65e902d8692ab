"""Ctrl-C and SIGTERM: a flag and an exception in Python, and a watch that needs neither where C code runs.

The handler notes the signal and raises `Interrupted`, which no `except Exception` catches. Code that would
swallow an exception runs shielded: there the signal is only noted, and raised when the shield ends. A call
into C that runs for long keeps Python's handler from running at all; it lets other threads run, so that a
watching thread, woken by the signal itself, ends the process when the grace is over, or at a second signal.
That one waits for nothing: it may find new results in place already, and says "interrupted" all the same.
"""

import os
import select
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import FrameType

from timelaw.errors import EXIT_INTERRUPTED

SIGNALS = (signal.SIGINT, signal.SIGTERM)
GRACE = 1.0  # seconds that Python has to end by itself; whoever waits is promised two
OVER_ZERO = EXIT_INTERRUPTED - signal.SIGINT  # a shell's exit code of a signal: 128 and its number


class Interrupted(KeyboardInterrupt):
    """A signal asked for the end."""

    def __init__(self, number: int = signal.SIGINT) -> None:
        self.exit_code = OVER_ZERO + number
        super().__init__("interrupted" if number == signal.SIGINT else "terminated")


@dataclass
class _State:
    """The first signal that came, and what runs that must not be broken off in the middle."""

    number: int | None = None
    shields: int = 0
    finishing: bool = False
    over: bool = False
    farewell: Callable[[Interrupted], None] | None = field(default=None, repr=False)


_state = _State()


def check_interrupted() -> None:
    """Raise what a signal asked for and nothing has raised yet, or what was swallowed.

    Raises:
        Interrupted: a signal came, and the work is not finished.
    """
    interrupt = find_interrupt()
    if interrupt is not None:
        raise interrupt


def find_interrupt() -> Interrupted | None:
    """What a signal asked for before the work was finished."""
    return None if _state.number is None or _state.finishing else Interrupted(_state.number)


@contextmanager
def shield() -> Iterator[None]:
    """Signals are noted inside and raised at its end: for calls that swallow exceptions.

    Raises:
        Interrupted: a signal came.
    """
    check_interrupted()
    _state.shields += 1
    try:
        yield
    finally:
        _state.shields -= 1
        if not _state.shields:
            check_interrupted()


@contextmanager
def finish_work() -> Iterator[None]:
    """The step that makes results appear: a signal before it undoes all, one in it or after it nothing.

    Where the step itself fails, the signal counts.

    Raises:
        Interrupted: a signal came before.
    """
    check_interrupted()
    _state.finishing = True
    try:
        yield
    except BaseException:
        _state.finishing = False
        raise


def say_last_words() -> None:
    """What follows are a few lines that say why there are no results: a signal adds nothing."""
    if _state.number is None:
        _state.finishing = True


def handle_signals(farewell: Callable[[Interrupted], None]) -> None:
    """From now on signals end this process; `farewell` says so where Python's main thread cannot."""
    _state.farewell = farewell
    for number in SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:  # as `nohup` and shells start what they keep
            signal.signal(number, _note)
    if os.name == "posix":
        read, write = os.pipe()
        os.set_blocking(write, False)
        signal.set_wakeup_fd(write, warn_on_full_buffer=False)
        threading.Thread(target=_watch, args=(read,), daemon=True, name="signals").start()


def ignore_signals() -> None:
    """All is said and done: what is left is the interpreter's own end, which a signal would garble."""
    _state.over = True
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)


def _note(number: int, _frame: FrameType | None) -> None:
    if _state.number is not None:
        if os.name != "posix":
            os._exit(OVER_ZERO + _state.number)  # nobody watches there
        return
    _state.number = number
    if not _state.shields and not _state.finishing:
        raise Interrupted(number)


def _watch(pipe: int) -> None:
    """Wait for two signals, or for one and the end of the grace; then leave."""
    numbers: list[int] = []
    ends: float | None = None
    while True:
        left = None if ends is None else max(ends - time.monotonic(), 0.0)
        if not select.select([pipe], [], [], left)[0]:
            break
        numbers += [number for number in os.read(pipe, 64) if number in SIGNALS]
        if len(numbers) > 1:
            break
        if numbers and ends is None:
            ends = time.monotonic() + GRACE
    if _state.over:
        return
    leaving = Interrupted(numbers[0])
    try:
        if _state.farewell is not None:
            _state.farewell(leaving)
    finally:
        os._exit(leaving.exit_code)
