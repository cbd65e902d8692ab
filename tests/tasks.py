"""What the tests give to other processes, which load no more than this for it."""

import os
import signal
from pathlib import Path

from timelaw.errors import Fault, InputError

WRONG, DEADLY, DEFECT, FRAIL = 3, 4, 5, 6


def double(number: int, mark: Path | None = None) -> int:
    """Twice the number, but for some: one is killed always, one until there is a mark."""
    if number == WRONG:
        raise InputError(Fault("three", "where", "path", 1, 2))
    if number == DEADLY or (number == FRAIL and mark is not None and not mark.exists()):
        if mark is not None:
            mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    if number == DEFECT:
        raise ZeroDivisionError("five")
    return 2 * number
