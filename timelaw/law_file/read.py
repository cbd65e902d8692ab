"""Read a law file: JSON, version 2, as plain data and as the motion it defines."""

import json
import re
from collections import Counter
from math import isfinite
from pathlib import Path
from typing import Any

from timelaw.errors import Fault, InputError, shorten
from timelaw.files import read_text
from timelaw.law_file.document import from_document
from timelaw.motion import QuaternionLaw

MAX_BYTES = 50_000_000
MOST_PARTS = 3_000_000  # lists, objects, values: 37 000 arcs of degree 9, or 210 000 pieces of splines; 5 s
OTHER_KINDS = {  # by a key that starts them: what it is, and what to do with it
    "timelaw-study": "this is a study file, not a law file; use it with: timelaw sweep {path}",
    "timelaw": "this is a problem file, not a law file; run timelaw design {path} first, and verify the "
    "law.json that it writes",
}


def read_law(path: Path) -> tuple[QuaternionLaw, dict[str, Any]]:
    """The quaternion law in a file, and all that the file holds.

    Raises:
        InputError: the file cannot be read, is not JSON, or is not a law file of this version.
    """
    document = _parse(read_text(path, MAX_BYTES), path)
    if not isinstance(document, dict):
        raise InputError(Fault("not a law file: its content is not an object", "", str(path)))
    if "format" not in document:  # JSON is YAML too
        _refuse_other_kinds("\n".join(f"{key}:" for key in OTHER_KINDS if key in document), path)
    return from_document(document, str(path)), document


def _parse(text: str, path: Path) -> Any:
    """Plain data of a JSON text."""
    excess = find_excess(text)
    if excess:
        raise InputError(Fault(excess, "", str(path)))
    hooks: dict[str, Any] = {"parse_constant": _number, "parse_float": _number, "parse_int": _whole}
    try:
        return json.loads(text, object_pairs_hook=_once, **hooks)
    except json.JSONDecodeError as error:
        _refuse_other_kinds(text, path)
        message = f"not readable as JSON: {error.msg}"
        raise InputError(Fault(message, "", str(path), error.lineno, error.colno)) from None
    except (ValueError, RecursionError) as error:
        what = "nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise InputError(Fault(f"not readable as JSON: {what}", "", str(path))) from None


def find_excess(text: str) -> str:
    """In what a JSON text is more than can be read; empty if it can.

    Values are counted, for three bytes can take as much memory as a number of twenty.
    """
    parts = sum(map(text.count, "[{,"))
    if parts > MOST_PARTS:
        return f"{parts} values; at most {MOST_PARTS} are allowed"
    if len(text) > MAX_BYTES:
        return f"{len(text)} characters; at most {MAX_BYTES} are allowed"
    return ""


def _refuse_other_kinds(text: str, path: Path) -> None:
    """Say in one sentence that a file is of another kind, where its keys show it."""
    for key, message in OTHER_KINDS.items():
        if re.search(rf"^{key}\s*:", text, re.MULTILINE):
            raise InputError(Fault(message.format(path=path), "", str(path)))


def _number(text: str) -> float:
    number = float(text)
    if not isfinite(number):
        raise ValueError(f"{shorten(text)} is not a finite number")
    return number


def _whole(text: str) -> int:
    _number(text)
    return int(text)


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object whose keys stand once each."""
    read = dict(pairs)
    if len(read) < len(pairs):
        counts = Counter(key for key, _ in pairs)
        raise ValueError(f'duplicate key "{shorten(next(key for key in counts if counts[key] > 1))}"')
    return read
