"""The log of a sweep: every outcome a line of its own, written as it comes; what is in it is not done again.

It stands in the folder of results, but is none of them: it grows while earlier results are whole, and stays
when they are replaced. A run that is killed leaves whole lines and at most one that was cut off at the end.
"""

import errno
import json
import os
import stat
from collections import UserDict
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from pydantic_core import from_json

from timelaw.errors import Fault, InputError
from timelaw.files import name_refusals, replace_unbounded
from timelaw.results_folder.locks import try_lock
from timelaw.study.outcome import Outcome, parse_outcome

NAME = "sweep.jsonl"
FORMAT, VERSION = "timelaw-sweep-log", 1
MOST_BYTES = 200_000_000  # 10 000 designs take a twentieth
HEAD = json.dumps({"format": FORMAT, "version": VERSION}) + "\n"


class SweepLog(UserDict[str, Outcome]):
    """Outcomes by the key of their point; a new one is on the disk before it is in here."""

    def __init__(self, path: Path, descriptor: int) -> None:
        super().__init__()
        self.path = path
        self.cut_off = False
        self.unreadable = 0
        self._descriptor = descriptor
        self._read(path)

    def __setitem__(self, key: str, outcome: Outcome) -> None:
        """Append a line.

        Raises:
            InputError: it cannot be written; what was there is whole.
        """
        line = json.dumps(replace_unbounded({"key": key, **outcome.to_dict()}), default=str)
        with name_refusals(self.path):
            self._append(line)
        self.data.update([_parse_line(line)])

    def _append(self, line: str) -> None:
        content = (line + "\n").encode()
        end = os.fstat(self._descriptor).st_size
        written = os.write(self._descriptor, content)
        if written < len(content):
            os.ftruncate(self._descriptor, end)
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def _read(self, path: Path) -> None:
        """Take in what is there, and drop a last line that was cut off."""
        with os.fdopen(os.dup(self._descriptor), "rb") as file:
            content = file.read()
        whole, end, rest = content.rpartition(b"\n")
        if HEAD.encode().startswith(content):  # new, or killed before anything was done
            os.ftruncate(self._descriptor, 0)
            self._append(HEAD.removesuffix("\n"))
            return
        head, *lines = whole.splitlines() if end else [content]
        _refuse_other_files(head, path)
        self.cut_off = bool(rest)
        os.ftruncate(self._descriptor, len(whole) + len(end))
        for line in lines:
            try:
                key, outcome = _parse_line(line)
            except ValueError:
                self.unreadable += 1
            else:
                self.data.setdefault(key, outcome)


def _parse_line(line: str | bytes) -> tuple[str, Outcome]:
    """The key and the outcome of a line.

    Raises:
        ValueError: it holds none.
    """
    data = from_json(line)
    if not isinstance(data, dict) or not isinstance(data.get("key"), str):
        raise ValueError("no entry")
    return data.pop("key"), parse_outcome(data)


def _refuse_other_files(head: bytes, path: Path) -> None:
    """Take nobody's file for a log.

    Raises:
        InputError: the first line is not that of a log.
    """
    try:
        found = from_json(head)
    except ValueError:
        found = None
    what = ""
    if not isinstance(found, dict) or found.get("format") != FORMAT:
        what = "is not the log of a sweep"
    elif found.get("version") != VERSION:
        what = "is the log of another version of timelaw"
    if what:
        raise InputError(Fault(f"{what}; move it away, or take another folder", "", str(path)))


@contextmanager
def open_log(folder: Path) -> Iterator[SweepLog]:
    """The log of a folder of results, for this process alone; if nothing comes of it, it leaves no trace.

    Raises:
        InputError: it cannot be written, is no log, or another sweep writes it.
    """
    path = folder / NAME
    made = [one for one in (folder, *folder.parents) if not one.exists()]
    with name_refusals(path):
        folder.mkdir(parents=True, exist_ok=True)
        descriptor = _open_alone(path)
    try:
        with name_refusals(path):
            log = SweepLog(path, descriptor)
        try:
            yield log
        finally:
            if os.fstat(descriptor).st_size == len(HEAD):
                _remove(path, made)
    finally:
        os.close(descriptor)


def _remove(path: Path, made: list[Path]) -> None:
    """A log without outcomes, and the folders that were made for it and hold nothing else."""
    with suppress(OSError):
        path.unlink()
        for folder in made:
            folder.rmdir()


def _open_alone(path: Path) -> int:
    """A descriptor of the file that stands at the path, and its lock, which ends with this process.

    Raises:
        OSError: it is held by another, or cannot be written.
    """
    while True:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o666)
        try:
            status = os.fstat(descriptor)
            if not stat.S_ISREG(status.st_mode) or status.st_size > MOST_BYTES:
                raise OSError(errno.EFBIG, f"it is no file of at most {MOST_BYTES // 1_000_000} MB")
            if try_lock(descriptor) is False:
                raise OSError(
                    errno.EBUSY, "another sweep is writing it; wait for its end, or take another folder"
                )
            if _is_at(path, status):
                return descriptor
        except OSError:
            os.close(descriptor)
            raise
        os.close(descriptor)  # whoever held it found nothing to keep, and removed it


def _is_at(path: Path, status: os.stat_result) -> bool:
    with suppress(FileNotFoundError):
        return os.path.samestat(path.stat(), status)
    return False
