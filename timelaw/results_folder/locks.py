"""Locks that end with the process that holds them, so that nothing has to be believed of a dead one.

Where the system or its file system knows no such locks, nothing is locked: two runs into one folder at the
same moment are then left to chance, each file of them still being whole.
"""

import errno
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

WAIT = 10.0  # seconds for what takes others milliseconds
PAUSE = 0.01  # seconds

DEAD = 86400.0  # seconds after which a run that cannot be asked for its lock is taken for dead

if sys.platform == "win32":

    def try_lock(_descriptor: int) -> bool | None:
        """None: there are no such locks."""
        return None
else:
    import fcntl

    def try_lock(descriptor: int) -> bool | None:
        """Whether the lock was taken; None where there are no locks."""
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        except OSError:
            return None
        return True


@contextmanager
def hold(path: Path) -> Iterator[None]:
    """Hold the lock of a file or folder, waiting for whoever has it.

    Raises:
        TimeoutError: it was not given up.
    """
    if sys.platform == "win32" and path.is_dir():  # folders cannot be opened there
        yield
        return
    descriptor = os.open(path, os.O_RDONLY)
    try:
        _wait_for(descriptor)
        yield
    finally:
        os.close(descriptor)


@contextmanager
def hold_new(path: Path) -> Iterator[None]:
    """Make a file and hold its lock: a sign that whoever made it lives."""
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
    try:
        _wait_for(descriptor)
        yield
    finally:
        os.close(descriptor)


def _wait_for(descriptor: int) -> None:
    ends = time.monotonic() + WAIT
    while try_lock(descriptor) is False:
        if time.monotonic() > ends:
            raise TimeoutError(errno.ETIMEDOUT, "another run is writing there")
        time.sleep(PAUSE)


def is_held(path: Path) -> bool:
    """Whether a living run holds this lock file; where there are no locks, whether it is young."""
    try:
        descriptor = os.open(path, os.O_RDWR)
    except OSError:
        return False
    try:
        taken = try_lock(descriptor)
        return time.time() - os.fstat(descriptor).st_mtime < DEAD if taken is None else not taken
    finally:
        os.close(descriptor)
