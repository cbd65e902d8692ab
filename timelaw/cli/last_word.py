"""The one object on stdout: printed by the command, or by whoever ends it, but never twice or in part."""

import json
import sys
import threading
from typing import Any

from timelaw.cli.streams import write_last
from timelaw.files import replace_unbounded
from timelaw.interrupts import Interrupted

_printing = threading.Lock()
_printed = threading.Event()


def wants_json(arguments: list[str]) -> bool:
    """Whether an object is asked for; also where the command line is wrong otherwise."""
    return "--json" in arguments[: arguments.index("--") if "--" in arguments else None]


def print_object(data: dict[str, Any]) -> None:
    """One object on stdout; what has no bound, or is no number, is null: findings say what it is."""
    text = json.dumps(replace_unbounded(data), indent=1, allow_nan=False)
    with _printing:
        print(text, flush=True)
        _printed.set()


def say_farewell(interrupt: Interrupted) -> None:
    """From any thread, past all buffers: what ended the work, and the object if it was not printed."""
    write_last(2, f"timelaw: {interrupt}\n")
    if wants_json(sys.argv[1:]) and _printing.acquire(blocking=False) and not _printed.is_set():
        fault = {"message": str(interrupt), "where": "", "path": "", "line": None, "column": None}
        object_ = {"ok": False, "exit_code": interrupt.exit_code, "errors": [fault]}
        write_last(1, json.dumps(object_, indent=1) + "\n")
        _printed.set()
