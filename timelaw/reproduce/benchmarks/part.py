"""A part of the benchmarks, and what has to be there for it."""

from dataclasses import dataclass
from typing import Protocol

from timelaw.reproduce.benchmarks.table import Table


class Measure(Protocol):
    """How a part is measured; `quick` takes fewer sizes and repeats."""

    def __call__(self, *, quick: bool) -> Table: ...  # noqa: D102


@dataclass(frozen=True)
class Part:
    """A part by its name, which is the mark of its table on the page; its columns, and how it is measured."""

    name: str
    headings: tuple[str, ...]
    measure: Measure
