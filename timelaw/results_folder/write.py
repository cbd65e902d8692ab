"""Replace the results of a command in a folder, all of them or none.

Everything is written to a hidden folder beside, which then takes the place of the old one in a single step;
what the old one holds besides, files of the user and results of other commands, is linked into the new one
before. A run that is killed leaves the old folder or the new one, and hidden ones that the next run removes.

Where the system knows no such exchange, the old folder is renamed, then the new one; killed in between, the
next run renames the old one back. Where the folder cannot be replaced (it is where the command runs, or a
mount point, nothing may be written beside it, or its other files cannot be linked) its files are replaced one
by one from a hidden folder inside it, `law.json` last, with a journal from which the next run finishes.
"""

import errno
import os
import shutil
import stat
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from timelaw.errors import Fault, InputError
from timelaw.files import Content, read_umask, write_content
from timelaw.interrupts import finish_work
from timelaw.results_folder.carry import catch_up, link_tree
from timelaw.results_folder.locks import hold, hold_new
from timelaw.results_folder.manifest import MANIFEST, format_manifest, read_manifest
from timelaw.results_folder.names import LOCK, find_place, list_inside, make_beside, make_inside, name_aside
from timelaw.results_folder.one_by_one import complete, has_journal, write_journal
from timelaw.results_folder.repair import repair_held, repair_inside
from timelaw.results_folder.swap import swap_folders

Contents = Mapping[str, Content]
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)  # no other way of writing helps


def write_results(folder: Path, command: str, files: Contents) -> None:
    """Make `files`, contents by name, the results of a command in a folder, in place of its earlier ones.

    Raises:
        InputError: the folder cannot be written; it is as it was.
        Interrupted: a signal came before the new results were in their place; likewise.
    """
    try:
        place = find_place(folder)
        _refuse_taken(place, files)
        if not _is_replaceable(place) or not _write_beside(place, command, files):
            _write_inside(place, command, files)
    except OSError as error:
        where = str(folder)
        if error.filename and Path(error.filename).name in files:
            where = str(folder / Path(error.filename).name)
        raise InputError(Fault(f"cannot be written: {error.strerror or error}", "", where)) from None


def _refuse_taken(folder: Path, files: Contents) -> None:
    """What stands in the way and is nobody's to remove.

    Raises:
        OSError: the folder is a file, or a file's name that of a folder.
    """
    if folder.exists() and not folder.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), str(folder))
    for name in files:
        if (folder / name).is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(folder / name))


def _is_replaceable(folder: Path) -> bool:
    """Whether another folder may take its place: nobody's working folder, no mount point."""
    try:
        here = Path.cwd()
    except OSError:  # a folder that is gone
        return not os.path.ismount(folder)
    return not (folder == here or folder in here.parents or os.path.ismount(folder))


def _write_beside(folder: Path, command: str, files: Contents) -> bool:
    """Write a new folder and put it in the place; False where that is not possible, nothing being changed.

    Raises:
        OSError: no space is left.
    """
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with _staged(folder.parent, lambda: make_beside(folder)) as staging:
            _write_whole(staging, files)
            with finish_work(), hold(folder.parent):
                _put_in_place(staging, folder, command, files)
    except OSError as error:
        if error.errno in FULL:
            raise
        return False
    return True


@contextmanager
def _staged(within: Path, make: Callable[[], Path]) -> Iterator[Path]:
    """A new hidden folder whose lock is held; removed where what is done with it fails.

    It is made with the lock of the folder it is made in, so that nobody takes it for a dead run's.
    """
    with ExitStack() as held:
        with hold(within):
            staging = make()
            held.enter_context(hold_new(staging / LOCK))
        try:
            yield staging
        except BaseException:
            if not has_journal(staging):
                shutil.rmtree(staging, ignore_errors=True)
            raise


def _put_in_place(staging: Path, folder: Path, command: str, files: Contents) -> None:
    """With the parent's lock held: the new folder takes the place; what was there is removed.

    Raises:
        OSError: nothing was changed.
    """
    repair_held(folder)
    if list_inside(folder):  # another run is in the middle of writing there
        raise OSError(errno.EBUSY, os.strerror(errno.EBUSY), str(folder))
    (staging / MANIFEST).write_text(format_manifest(folder, command, files), encoding="utf-8")
    own = {MANIFEST, LOCK, *files, *read_manifest(folder)[command]}
    if not folder.exists():
        shared = folder.parent.stat().st_mode & stat.S_ISGID  # a folder whose files are of its group
        os.chmod(staging, 0o777 & ~read_umask() | shared)
        (staging / LOCK).unlink()
        os.rename(staging, folder)
        return
    linked = link_tree(folder, staging, own)
    _take_after(folder, staging)
    (staging / LOCK).unlink()
    old = staging if swap_folders(staging, folder) else _replace_in_two_steps(staging, folder)
    _tidy(old, folder, own, linked)


def _take_after(folder: Path, staging: Path) -> None:
    """The owner, where that may be given away, and the rights of the old folder."""
    old, new = folder.stat(), staging.stat()
    if (old.st_uid, old.st_gid) != (new.st_uid, new.st_gid):
        with suppress(OSError):
            os.chown(staging, old.st_uid, old.st_gid)
    shutil.copymode(folder, staging)


def _replace_in_two_steps(staging: Path, folder: Path) -> Path:
    """Where no exchange is known: the old folder aside, then the new one in; returns the old one's place."""
    aside = name_aside(staging)
    os.rename(folder, aside)
    try:
        os.rename(staging, folder)
    except OSError:
        os.rename(aside, folder)
        raise
    return aside


def _tidy(old: Path, folder: Path, own: set[str], linked: dict[Path, int]) -> None:
    """Remove the old folder; the new results stand, whatever comes: the next run tries again."""
    with suppress(OSError):
        catch_up(old, folder, own, linked)
        shutil.rmtree(old)


def _write_inside(folder: Path, command: str, files: Contents) -> None:
    """Write all files to a hidden folder inside, then put them in their places one by one.

    Raises:
        OSError: it cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with _staged(folder, lambda: make_inside(folder)) as staging:
        _write_whole(staging, files)
        with finish_work(), hold(folder):
            repair_inside(folder)
            stale = set(read_manifest(folder)[command]) - set(files)
            text = format_manifest(folder, command, files)
            (staging / MANIFEST).write_text(text, encoding="utf-8")
            write_journal(staging, [*files, MANIFEST], sorted(stale))
            complete(staging, folder)


def _write_whole(folder: Path, files: Contents) -> None:
    """Write files, and wait until they are on the disk.

    Raises:
        OSError: one cannot be written; it is named.
    """
    for name, content in files.items():
        try:
            with (folder / name).open("wb") as file:
                write_content(file, content)
        except OSError as error:
            raise OSError(error.errno, error.strerror, str(folder / name)) from None
