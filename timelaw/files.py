"""Files whole: read up to a size, written whole or not at all, texts and bytes; plain data for JSON."""

import os
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from errno import EISDIR
from math import isfinite
from pathlib import Path
from typing import Any

from timelaw.errors import Fault, InputError
from timelaw.interrupts import finish_work

MAX_BYTES = 10_000_000  # far above any real problem file; a wrong file is refused before it is parsed


START = 1000  # bytes, in which a file shows of what kind it is


def read_start(path: Path) -> bytes:
    """The first bytes of a file.

    Raises:
        InputError: it cannot be read.
    """
    return _read(path, START)


def read_bytes(path: Path, most: int = MAX_BYTES) -> bytes:
    """The content of a file of at most so many bytes.

    Raises:
        InputError: it is larger or cannot be read.
    """
    content = _read(path, most + 1)
    if len(content) > most:
        raise InputError(Fault(f"larger than {most // 1_000_000} MB", "", str(path)))
    return content


def _read(path: Path, most: int) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(most)
    except OSError as error:
        raise InputError(Fault(f"cannot be read: {error.strerror or error}", "", str(path))) from None
    except ValueError as error:  # a name that no file can have
        raise InputError(Fault(f"cannot be read: {error}", "", repr(str(path)))) from None


def read_text(path: Path, most: int = MAX_BYTES) -> str:
    """The text (UTF-8) of a file of at most so many bytes.

    Raises:
        InputError: it is larger, cannot be read, or is no text.
    """
    try:
        return read_bytes(path, most).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(Fault("is not a UTF-8 text", "", str(path))) from None


def replace_unbounded(data: Any) -> Any:
    """Plain data as JSON can hold it: null for numbers that are not finite."""
    if isinstance(data, dict):
        return {key: replace_unbounded(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [replace_unbounded(value) for value in data]
    return None if isinstance(data, float) and not isfinite(data) else data


def write_file(path: Path, content: str | bytes) -> None:
    """Replace `path` by a text or by bytes in one step; see `write_files`."""
    write_files({path: content})


def write_text(path: Path, text: str) -> None:
    """Replace `path` by `text` (UTF-8, lines as they are) in one step; see `write_files`."""
    write_files({path: text})


def write_files(contents: Mapping[Path, str | bytes]) -> None:
    """Replace files by texts (UTF-8) or bytes; a reader never sees half a file.

    All are written beside their places first, then each takes its place in one step.

    Raises:
        InputError: one cannot be written; where a folder or the disk allows none, all are as they were.
        Interrupted: a signal came before the first was in its place; likewise.
    """
    written: dict[Path, str] = {}
    try:
        for path, content in contents.items():
            with _naming(path):
                _write_beside(path, content, written)
        with finish_work():
            for path, temporary in list(written.items()):
                with _naming(path):
                    os.replace(temporary, path)
                del written[path]
    finally:
        for temporary in written.values():
            with suppress(OSError):
                os.unlink(temporary)


def _write_beside(path: Path, content: str | bytes, written: dict[Path, str]) -> None:
    """Write a temporary file in the folder of `path`, and note its name before anything may fail.

    Raises:
        OSError: it cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir():
        raise IsADirectoryError(EISDIR, os.strerror(EISDIR))
    handle, written[path] = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    with os.fdopen(handle, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode("utf-8", errors="replace"))
        file.flush()
        os.fsync(file.fileno())
    os.chmod(written[path], 0o666 & ~read_umask())


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """What the system refuses is told of this file.

    Raises:
        InputError: something was refused.
    """
    try:
        yield
    except OSError as error:
        raise InputError(Fault(f"cannot be written: {error.strerror or error}", "", str(path))) from None


def read_umask() -> int:
    """The rights that new files and folders of this process do not get."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
