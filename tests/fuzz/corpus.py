"""The saved files that are spoilt, by the reader that reads them."""

from functools import cache
from pathlib import Path

FOLDER = Path(__file__).parent / "corpus"
KINDS = ("problem", "study", "table", "angles", "attitude", "law")


@cache
def read_corpus(kind: str) -> dict[str, bytes]:
    """Names and contents."""
    return {path.name: path.read_bytes() for path in sorted((FOLDER / kind).iterdir())}


def lay_corpus(folder: Path) -> None:
    """All files in one folder, where problems find their tables and studies their problems."""
    for kind in KINDS:
        for name, content in read_corpus(kind).items():
            (folder / name).write_bytes(content)
