"""Files put in place one by one, from a hidden folder whose journal says which: what is begun is finished."""

import json
import os
import shutil
from collections.abc import Iterable
from pathlib import Path

from timelaw.results_folder.names import JOURNAL

LAST = "law.json"  # with it in its place everything it speaks of is in its place


def write_journal(staging: Path, names: Iterable[str], stale: Iterable[str]) -> None:
    """From here on the files of `staging` are the results: to be moved, and the stale ones removed.

    Raises:
        OSError: it cannot be written; then they are not.
    """
    text = json.dumps({"move": sorted(names, key=lambda name: name == LAST), "remove": list(stale)})
    draft = staging / (JOURNAL + "~")
    draft.write_text(text, encoding="utf-8")
    os.replace(draft, staging / JOURNAL)


def has_journal(staging: Path) -> bool:
    """Whether its files are to be moved: if not, it was given up before."""
    return (staging / JOURNAL).exists()


def complete(staging: Path, folder: Path) -> None:
    """Do what is left to be done of a journal, and remove the hidden folder.

    Raises:
        OSError: a file cannot be moved; the journal stays for the next run.
    """
    journal = json.loads((staging / JOURNAL).read_text(encoding="utf-8"))
    for name in journal["remove"]:
        (folder / name).unlink(missing_ok=True)
    for name in journal["move"]:
        if (staging / name).exists():
            os.replace(staging / name, folder / name)
    shutil.rmtree(staging, ignore_errors=True)
