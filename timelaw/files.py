"""Files whole: read at once up to a size, written whole or not at all, texts and bytes."""

import os
import tempfile
from pathlib import Path

from timelaw.errors import Fault, InputError

MAX_BYTES = 10_000_000  # far above any real problem file; a wrong file is refused before it is parsed


def read_bytes(path: Path, most: int = MAX_BYTES) -> bytes:
    """The content of a file of at most so many bytes.

    Raises:
        InputError: it is larger or cannot be read.
    """
    try:
        with path.open("rb") as file:
            content = file.read(most + 1)
    except OSError as error:
        raise InputError(Fault(f"cannot be read: {error.strerror or error}", "", str(path))) from None
    except ValueError as error:  # a name that no file can have
        raise InputError(Fault(f"cannot be read: {error}", "", repr(str(path)))) from None
    if len(content) > most:
        raise InputError(Fault(f"larger than {most // 1_000_000} MB", "", str(path)))
    return content


def read_text(path: Path, most: int = MAX_BYTES) -> str:
    """The text (UTF-8) of a file of at most so many bytes.

    Raises:
        InputError: it is larger, cannot be read, or is no text.
    """
    try:
        return read_bytes(path, most).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(Fault("is not a UTF-8 text", "", str(path))) from None


def write_file(path: Path, content: str | bytes) -> None:
    """Replace `path` by a text or by bytes."""
    write_bytes(path, content) if isinstance(content, bytes) else write_text(path, content)


def write_text(path: Path, text: str) -> None:
    """Replace `path` by `text` (UTF-8, lines as they are) in one step; see `write_bytes`."""
    write_bytes(path, text.encode("utf-8", errors="replace"))


def write_bytes(path: Path, content: bytes) -> None:
    """Replace `path` in one step; a reader never sees half a file.

    Raises:
        InputError: the folder cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(content)
            os.chmod(temporary, 0o666 & ~_umask())
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise
    except OSError as error:
        raise InputError(Fault(f"cannot be written: {error.strerror or error}", "", str(path))) from None


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
