"""Where the process begins and ends: streams and signals first, then everything that takes time to load."""

import os
import sys
from typing import Any, NoReturn

from timelaw.cli.last_word import say_farewell
from timelaw.cli.streams import prepare_streams
from timelaw.interrupts import Interrupted, find_interrupt, handle_signals, ignore_signals


def main() -> NoReturn:
    """Run the command line and leave with its exit code."""
    code = 1  # of a defect of ours, whose traceback Python prints
    try:
        prepare_streams()
        sys.unraisablehook = _tell_unraisable
        handle_signals(say_farewell)
        from timelaw.cli.app import run_command

        code = run_command(sys.argv[1:])
    except KeyboardInterrupt as error:  # while loading or printing
        say_farewell(error if isinstance(error, Interrupted) else Interrupted())
        code = Interrupted().exit_code
    finally:
        interrupt = find_interrupt()
        ignore_signals()
        if interrupt is not None:  # at once: what waits for the interpreter's end may take long
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(interrupt.exit_code)
    sys.exit(code)


def _tell_unraisable(unraisable: Any) -> None:
    """What is raised where nothing can be raised is told, but for interrupts, which are raised again."""
    if not isinstance(unraisable.exc_value, Interrupted):
        sys.__unraisablehook__(unraisable)
