"""What a folder holds besides results goes along to the one that replaces it, linked: both have it."""

import errno
import os
import shutil
from collections.abc import Callable, Iterator, Set
from pathlib import Path

MOST_LINKED = 10_000  # files and folders; linking them takes a tenth of a second


def link_tree(old: Path, new: Path, leave: Set[str]) -> dict[Path, int]:
    """Link all files of `old` into `new`, folders made anew, but for the names to `leave` at its top.

    Returns the number of the file (inode) by its path in the folder.

    Raises:
        OSError: something cannot be linked, or there is too much of it.
    """
    linked: dict[Path, int] = {}
    for name, entry in _walk(old, leave, lambda _, entry: entry.is_dir(follow_symlinks=False)):
        if len(linked) >= MOST_LINKED:
            raise OSError(errno.EMFILE, "too many files besides the results", str(old))
        if entry.is_dir(follow_symlinks=False):
            (new / name).mkdir()
        else:
            os.link(old / name, new / name, follow_symlinks=False)
        linked[name] = entry.inode()
    for name in reversed(linked):  # inner folders first: filling one changes its time
        if (new / name).is_dir() and not (new / name).is_symlink():
            shutil.copystat(old / name, new / name)
    return linked


def catch_up(old: Path, new: Path, leave: Set[str], linked: dict[Path, int]) -> None:
    """After the exchange: what was saved, made or removed in `old` after it was linked.

    What was changed in `new` since stays. Folders that are empty now stay too.
    """

    def is_in_both(name: Path, entry: os.DirEntry[str]) -> bool:
        return entry.is_dir(follow_symlinks=False) and (new / name).is_dir()

    seen: set[Path] = set()
    for name, entry in _walk(old, leave, is_in_both):
        seen.add(name)
        if is_in_both(name, entry):
            continue
        if linked.get(name) != entry.inode() and _number(new / name) in (None, linked.get(name)):
            os.replace(old / name, new / name)
    for name, number in linked.items():
        if name not in seen and _number(new / name) == number:
            (new / name).unlink()


def salvage(left: Path, folder: Path, leave: Set[str]) -> None:
    """What a replaced folder has that is neither a result nor in the folder that replaced it."""
    for entry in _list_entries(left):
        if entry.name not in leave and not os.path.lexists(folder / entry.name):
            os.replace(entry.path, folder / entry.name)


def _walk(
    folder: Path, leave: Set[str], enters: Callable[[Path, os.DirEntry[str]], bool]
) -> Iterator[tuple[Path, os.DirEntry[str]]]:
    """Everything in a folder by its path there, but for the names to `leave` at its top."""
    waiting = [Path()]
    while waiting:
        inner = waiting.pop()
        for entry in _list_entries(folder / inner):
            name = inner / entry.name
            if str(name) not in leave:
                if enters(name, entry):
                    waiting.append(name)
                yield name, entry


def _list_entries(folder: Path) -> list[os.DirEntry[str]]:
    with os.scandir(folder) as entries:
        return list(entries)


def _number(path: Path) -> int | None:
    """The number of the file at a path, None where there is none."""
    try:
        return path.lstat().st_ino
    except OSError:
        return None
