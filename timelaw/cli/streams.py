"""Standard streams that never fail: closed, full or cut off, what is printed is lost and the work goes on."""

import io
import os
import select
import sys
from contextlib import suppress
from typing import Any

STANDARD = (0, 1, 2)  # descriptors: what we open must not be taken for one of them
PATIENCE = 0.1  # seconds for a last word to a stream that does not take it


class _Forgiving(io.RawIOBase):
    """Writes to a descriptor; after the first failure to nowhere."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor, self._broken = descriptor, False

    def write(self, data: Any) -> int:
        """Write what is taken of `data`, at least a byte, or pretend to have written all."""
        while not self._broken:
            try:
                return os.write(self._descriptor, data)
            except BlockingIOError:  # a pipe that its other user has set so
                select.select([], [self._descriptor], [])
            except OSError:
                self._broken = True
        return len(data)

    def writable(self) -> bool:
        """It always is."""
        return True

    def fileno(self) -> int:
        """The descriptor."""
        return self._descriptor

    def isatty(self) -> bool:
        """Whether somebody looks on."""
        return os.isatty(self._descriptor)


def prepare_streams() -> None:
    """Wrap stdout and stderr, and open what is closed to nowhere; to be called first of all."""
    for descriptor in STANDARD:
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # gets the lowest that is free: this one
    if os.name == "posix":
        sys.stdout, sys.stderr = _wrap(sys.stdout, 1), _wrap(sys.stderr, 2)


def _wrap(stream: Any, descriptor: int) -> io.TextIOWrapper:
    """A text stream as Python made it, but for what fails: characters it cannot write are spelt out."""
    raw = _Forgiving(descriptor)
    errors = getattr(stream, "errors", None) or "strict"
    return io.TextIOWrapper(
        io.BufferedWriter(raw),
        encoding=getattr(stream, "encoding", None) or "utf-8",
        errors="backslashreplace" if errors == "strict" else errors,
        line_buffering=descriptor == 2 or raw.isatty(),
    )


def write_last(descriptor: int, text: str) -> None:
    """Write past all buffers, from any thread, if somebody takes it soon."""
    with suppress(OSError, ValueError):
        if select.select([], [descriptor], [], PATIENCE)[1]:
            os.write(descriptor, text.encode("utf-8", "backslashreplace"))
