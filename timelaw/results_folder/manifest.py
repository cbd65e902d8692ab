"""Which files of a folder are results, and of which command: a small hidden file says so."""

import json
from collections.abc import Iterable
from pathlib import Path

MANIFEST = ".timelaw-files.json"
# What versions wrote that left no manifest.
KNOWN = {
    "design": ("law.json", "samples.csv", "report.html", "rates.svg", "easings.svg"),
    "sweep": ("sweep.csv", "front.svg"),
    "compare": (),
}


def read_manifest(folder: Path) -> dict[str, tuple[str, ...]]:
    """File names by command; of a command of which nothing is said those it is known to write."""
    try:
        said = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
        found = {str(command): tuple(filter(_is_name, names)) for command, names in said.items()}
    except (OSError, ValueError, AttributeError, TypeError):
        found = {}
    return KNOWN | found


def list_all(manifest: dict[str, tuple[str, ...]]) -> frozenset[str]:
    """Everything in a folder that is not the user's."""
    return frozenset(name for names in manifest.values() for name in names) | {MANIFEST}


def format_manifest(folder: Path, command: str, names: Iterable[str]) -> str:
    """The manifest of a folder in which a command is about to replace its results."""
    there = {
        other: [name for name in names if (folder / name).is_file()]
        for other, names in read_manifest(folder).items()
    }
    entries = {other: names for other, names in there.items() if names} | {command: list(names)}
    return json.dumps(dict(sorted(entries.items())), indent=1) + "\n"


def _is_name(name: object) -> bool:
    """Whether it is the name of a file in the folder itself, and no path out of it."""
    return isinstance(name, str) and name not in ("", ".", "..") and not set(name) & set("/\\\0")
