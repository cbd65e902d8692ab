"""What killed runs left of a folder of results: finished or undone, and removed, by the next run into it."""

import os
import shutil
from pathlib import Path

from timelaw.results_folder.carry import salvage
from timelaw.results_folder.locks import hold, is_held
from timelaw.results_folder.manifest import list_all, read_manifest
from timelaw.results_folder.names import ASIDE, LOCK, find_place, list_beside, list_inside
from timelaw.results_folder.one_by_one import complete, has_journal


def repair_results(folder: Path) -> None:
    """Make a folder what the last run into it left or should have left; never fails.

    What cannot be repaired now, for want of rights perhaps, is left to a later run.
    """
    try:
        place = find_place(folder)
        if list_beside(place):
            with hold(place.parent):
                repair_held(place)
        if list_inside(place):
            with hold(place):
                repair_inside(place)
    except (OSError, ValueError):
        return


def repair_held(folder: Path) -> None:
    """Repair from hidden folders beside, the parent's lock being held.

    Raises:
        OSError: something there cannot be moved.
    """
    left = [path for path in list_beside(folder) if not is_held(path / LOCK)]
    replaced = [path for path in left if path.name.endswith(ASIDE)]
    if replaced and not folder.exists():
        os.rename(replaced[0], folder)
        left.remove(replaced[0])
    for path in left:
        if not (path / LOCK).exists() and folder.exists():
            known = list_all(read_manifest(path)) | list_all(read_manifest(folder))
            salvage(path, folder, known)
        shutil.rmtree(path, ignore_errors=True)


def repair_inside(folder: Path) -> None:
    """Repair from hidden folders inside, the folder's lock being held.

    Raises:
        OSError: something there cannot be moved.
    """
    for path in list_inside(folder):
        if is_held(path / LOCK):
            continue
        if has_journal(path):
            complete(path, folder)
        else:
            shutil.rmtree(path, ignore_errors=True)
