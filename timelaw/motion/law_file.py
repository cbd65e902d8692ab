"""Read a law file: JSON, version 1, as plain data and as the motion it defines."""

import json
from pathlib import Path
from typing import Any

from timelaw.errors import Fault, InputError
from timelaw.motion.document import from_document
from timelaw.motion.quaternion_law import QuaternionLaw

MAX_BYTES = 500_000_000


def read_law(path: Path) -> tuple[QuaternionLaw, dict[str, Any]]:
    """The quaternion law in a file, and all that the file holds.

    Raises:
        InputError: the file cannot be read, is not JSON, or is not a law file of this version.
    """
    try:
        if path.stat().st_size > MAX_BYTES:
            raise InputError(Fault(f"larger than {MAX_BYTES // 1_000_000} MB", "", str(path)))
        text = path.read_text(encoding="utf-8-sig")
        document = json.loads(text, parse_constant=_refuse, object_pairs_hook=_once)
    except OSError as error:
        raise InputError(Fault(f"cannot be read: {error.strerror or error}", "", str(path))) from None
    except UnicodeDecodeError:
        raise InputError(Fault("is not a UTF-8 text", "", str(path))) from None
    except json.JSONDecodeError as error:
        raise InputError(
            Fault(f"not readable as JSON: {error.msg}", "", str(path), error.lineno, error.colno)
        ) from None
    except (ValueError, RecursionError) as error:
        what = "nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise InputError(Fault(f"not readable as JSON: {what}", "", str(path))) from None
    if not isinstance(document, dict):
        raise InputError(Fault("not a law file: its content is not an object", "", str(path)))
    return from_document(document, str(path)), document


def _refuse(constant: str) -> float:
    raise ValueError(f"{constant} is not a number")


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object whose keys stand once each."""
    read: dict[str, Any] = {}
    for key, value in pairs:
        if key in read:
            raise ValueError(f'duplicate key "{key}"')
        read[key] = value
    return read
