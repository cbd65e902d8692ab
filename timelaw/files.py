"""Files whole: read up to a size, written whole or not at all, texts and bytes; plain data for JSON."""

import os
import stat
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from errno import EISDIR
from io import TextIOWrapper
from math import isfinite
from pathlib import Path
from typing import Any, BinaryIO

from timelaw.errors import Fault, InputError
from timelaw.interrupts import finish_work

MAX_BYTES = 2_000_000  # of YAML, of which the slowest reads in 5 s; 5000 rotation matrices are half of it
OTHER_KINDS = {  # what has no end, or gives nothing until somebody writes; a folder is refused when opened
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}
WIDE = (b"\xff\xfe", b"\xfe\xff")  # how a text of two or four bytes a character begins
LONGEST_LABEL = 1000  # characters of a label or name in any file; they stand in many messages
LONGEST_LINE = 20_001  # characters of one that is streamed, and its end
MARK = b"\xef\xbb\xbf".decode("latin-1")  # of a UTF-8 text, read as Latin-1
START = 1000  # bytes, in which a file shows of what kind it is


@dataclass(frozen=True)
class Blocks:
    """A text too large to be held: `make` gives it block by block, whenever it is written."""

    make: Callable[[], Iterable[str]]

    def __iter__(self) -> Iterator[str]:
        """From its beginning."""
        return iter(self.make())


Content = str | bytes | Blocks


def read_start(path: Path) -> bytes:
    """The first bytes of a file.

    Raises:
        InputError: it cannot be read.
    """
    return _read(path, START, start=True)


def read_bytes(path: Path, most: int = MAX_BYTES) -> bytes:
    """The content of a file of at most so many bytes.

    Raises:
        InputError: it is larger or cannot be read.
    """
    content = _read(path, most)
    if len(content) > most:
        raise _too_large(path, most)
    return content


def _too_large(path: Path, most: int) -> InputError:
    return InputError(Fault(f"larger than {most // 1_000_000} MB, which is the most allowed", "", str(path)))


def _read(path: Path, most: int, *, start: bool = False) -> bytes:
    """One byte more than `most` of a file that has more; only its start, if that is asked for."""
    with _opened(path, None if start else most) as file:
        return file.read(most + 1)


@contextmanager
def _opened(path: Path, most: int | None) -> Iterator[BinaryIO]:
    """A regular file of at most so many bytes; what fails while it is read is told of it.

    Raises:
        InputError: it is of another kind, larger, or cannot be read.
    """
    try:
        status = path.stat()
        kind = OTHER_KINDS.get(stat.S_IFMT(status.st_mode))
        if kind is not None:  # before it is opened: that may wait for ever, and a device has no end
            raise InputError(Fault(f"cannot be read: it is {kind}; a regular file is needed", "", str(path)))
        if most is not None and status.st_size > most:
            raise _too_large(path, most)
        with path.open("rb") as file:
            yield file
    except OSError as error:
        raise InputError(Fault(f"cannot be read: {error.strerror or error}", "", str(path))) from None
    except ValueError as error:  # a name that no file can have
        raise InputError(Fault(f"cannot be read: {error}", "", repr(str(path)))) from None


def stream_lines(path: Path, most: int) -> Iterator[str]:
    """The lines of a text of at most so many bytes, one after the other, for files too large to be held.

    Whatever has not ASCII's letters is taken as Latin-1: names in old encodings do no harm to numbers.

    Raises:
        InputError: it is larger, cannot be read, is no text of one byte a character, or has endless lines.
    """
    with _opened(path, most) as binary:
        if binary.read(2) in WIDE:
            message = "seems to be UTF-16 or UTF-32: save it as UTF-8"
            raise InputError(Fault(f"is not a text of one byte a character; it {message}", "", str(path)))
        binary.seek(0)
        text = TextIOWrapper(binary, encoding="latin-1", newline=None)
        number = 0
        while line := text.readline(LONGEST_LINE):
            number += 1
            if len(line) == LONGEST_LINE:
                message = f"a line of more than {LONGEST_LINE - 1} characters"
                raise InputError(Fault(message, "", str(path), number, 1))
            yield line.rstrip("\n") if number > 1 else line.rstrip("\n").removeprefix(MARK)


def read_text(path: Path, most: int = MAX_BYTES) -> str:
    """The text (UTF-8) of a file of at most so many bytes.

    Raises:
        InputError: it is larger, cannot be read, or is no text.
    """
    content = read_bytes(path, most)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = content[: error.start]
        line, column = before.count(b"\n") + 1, error.start - before.rfind(b"\n")
        hint = "; it seems to be UTF-16 or UTF-32: save it as UTF-8" if content[:2] in WIDE else ""
        raise InputError(Fault(f"is not a UTF-8 text{hint}", "", str(path), line, column)) from None


def replace_unbounded(data: Any) -> Any:
    """Plain data as JSON can hold it: null for numbers that are not finite."""
    if isinstance(data, dict):
        return {key: replace_unbounded(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [replace_unbounded(value) for value in data]
    return None if isinstance(data, float) and not isfinite(data) else data


def write_file(path: Path, content: Content) -> None:
    """Replace `path` by a text or by bytes in one step; see `write_files`."""
    write_files({path: content})


def write_text(path: Path, text: str) -> None:
    """Replace `path` by `text` (UTF-8, lines as they are) in one step; see `write_files`."""
    write_files({path: text})


def write_files(contents: Mapping[Path, Content]) -> None:
    """Replace files by texts (UTF-8) or bytes; a reader never sees half a file.

    All are written beside their places first, then each takes its place in one step.

    Raises:
        InputError: one cannot be written; where a folder or the disk allows none, all are as they were.
        Interrupted: a signal came before the first was in its place; likewise.
    """
    written: dict[Path, str] = {}
    try:
        for path, content in contents.items():
            with name_refusals(path):
                _write_beside(path, content, written)
        with finish_work():
            for path, temporary in list(written.items()):
                with name_refusals(path):
                    os.replace(temporary, path)
                del written[path]
    finally:
        for temporary in written.values():
            with suppress(OSError):
                os.unlink(temporary)


def _write_beside(path: Path, content: Content, written: dict[Path, str]) -> None:
    """Write a temporary file in the folder of `path`, and note its name before anything may fail.

    Raises:
        OSError: it cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir():
        raise IsADirectoryError(EISDIR, os.strerror(EISDIR))
    handle, written[path] = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    with os.fdopen(handle, "wb") as file:
        write_content(file, content)
    os.chmod(written[path], 0o666 & ~read_umask())


def write_content(file: BinaryIO, content: Content) -> None:
    """Write a content to an open file, and wait until it is on the disk.

    Raises:
        OSError: it cannot be written.
    """
    for block in content if isinstance(content, Blocks) else (content,):
        file.write(block if isinstance(block, bytes) else block.encode("utf-8", errors="replace"))
    file.flush()
    os.fsync(file.fileno())


@contextmanager
def name_refusals(path: Path) -> Iterator[None]:
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
