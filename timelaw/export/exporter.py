"""What a format is in which a law leaves for other programs."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path

from timelaw.export.samples import MAX_ROWS
from timelaw.files import Content
from timelaw.motion import QuaternionLaw

NOON_2000 = datetime(2000, 1, 1, 12)


@dataclass(frozen=True)
class Options:
    """What users may choose, each where the format takes it.

    `rate` [1/s] of samples, the `epoch` at which a motion begins in formats with calendar times, numbers in
    `single` precision, and the `stem` of the files, by which texts call each other. A table has at `most` so
    many rows.
    """

    rate: float = 100.0
    epoch: datetime = NOON_2000
    single: bool = False
    stem: str = "law"
    most: int = MAX_ROWS


@dataclass(frozen=True)
class Exporter:
    """The usual name of its file, and the contents for a law, by suffix, that of the named file first.

    It says in a line what it `carries` and what it `loses`, and `takes` some of the options. `usual` ones are
    among the results of every design.
    """

    file_name: str
    write: Callable[[QuaternionLaw, Options], Mapping[str, Content]]
    carries: str
    loses: str
    takes: tuple[str, ...] = ("rate",)
    usual: bool = False

    def name_files(
        self, law: QuaternionLaw, options: Options, path: Path | None = None
    ) -> dict[str, Content]:
        """The contents by file name: the usual ones, or beside `path` and with its stem.

        A suffix of the path that is none of the format's names the first file all the same.
        """
        place = Path(self.file_name) if path is None else path
        contents = self.write(law, replace(options, stem=place.stem))
        first = next(iter(contents)) if place.suffix not in contents else place.suffix
        return {
            str(place if suffix == first else place.with_suffix(suffix)): content
            for suffix, content in contents.items()
        }
