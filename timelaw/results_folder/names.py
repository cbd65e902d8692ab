"""How folders are called while results are being written, and which are left over from killed runs."""

import errno
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path

ENDING = ".timelaw"
ASIDE = ".old" + ENDING  # what stood in the place, where two folders cannot be exchanged in one step
LOCK = ".lock"  # in a folder that is being written; its run holds it
JOURNAL = ".journal.json"  # in one whose files are being put in their places one by one
RANDOM = r"[a-z0-9_]{8}"  # as `tempfile` makes it


def find_place(folder: Path) -> Path:
    """Where a folder really is: results replace what a link points to, not the link.

    Raises:
        OSError: no folder can have this name, or its links go round.
    """
    try:
        return folder.resolve()
    except (RuntimeError, ValueError) as error:
        raise OSError(errno.EINVAL, str(error), str(folder)) from None


def make_beside(folder: Path) -> Path:
    """A new hidden folder beside one of results, `.NAME.XXXXXXXX.timelaw`."""
    return Path(tempfile.mkdtemp(ENDING, f".{folder.name}.", folder.parent))


def make_inside(folder: Path) -> Path:
    """A new hidden folder in one of results, `.XXXXXXXX.timelaw`."""
    return Path(tempfile.mkdtemp(ENDING, ".", folder))


def name_aside(staging: Path) -> Path:
    """Where the old folder waits while the new one is put in its place."""
    return staging.with_name(staging.name.removesuffix(ENDING) + ASIDE)


def list_beside(folder: Path) -> list[Path]:
    """Hidden folders of earlier or other runs beside one of results."""
    pattern = rf"\.{re.escape(folder.name)}\.{RANDOM}(\.old)?{re.escape(ENDING)}"
    return sorted(_list_folders(folder.parent, re.compile(pattern)))


def list_inside(folder: Path) -> list[Path]:
    """Hidden folders of earlier or other runs in one of results."""
    return sorted(_list_folders(folder, re.compile(rf"\.{RANDOM}{re.escape(ENDING)}")))


def _list_folders(parent: Path, pattern: re.Pattern[str]) -> Iterator[Path]:
    if parent.is_dir():
        for path in parent.iterdir():
            if pattern.fullmatch(path.name) and path.is_dir() and not path.is_symlink():
                yield path
