"""What a section of the report is, and what all of them may draw from."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from timelaw.pipeline import Design
from timelaw.report.summary import LawRow, list_law_rows

RATES = (("omega", "ω", "deg/s"), ("alpha", "α", "deg/s²"), ("jerk", "jerk", "deg/s³"))


@dataclass(frozen=True)
class Facts:
    """A design, the digest of its problem file, its pictures as SVG texts; what is computed once for all."""

    design: Design
    digest: str
    pictures: Mapping[str, str]

    @cached_property
    def rows(self) -> list[LawRow]:
        """The laws side by side."""
        return list_law_rows(self.design)


@dataclass(frozen=True)
class Section:
    """A title, empty for none, the template of its body, what it is filled with, and to what it applies."""

    title: str
    template: str
    context: Callable[[Facts], dict[str, Any]]
    applies: Callable[[Design], bool] = lambda _: True
