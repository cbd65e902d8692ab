"""What a section of the report is, and what all of them may draw from."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from markupsafe import Markup

from timelaw.pipeline import Design
from timelaw.report.figures.drawn import Scene
from timelaw.report.summary import LawRow, list_law_rows

RATES = (("omega", "ω", "deg/s"), ("alpha", "α", "deg/s²"), ("jerk", "jerk", "deg/s³"))
FOLDED = 24  # rows; longer tables are folded


@dataclass(frozen=True)
class Inline:
    """A picture as the page holds it, for screens and paper, and for phones."""

    wide: Markup
    narrow: Markup


@dataclass(frozen=True)
class Facts:
    """A design, the digest of its problem file, what is drawn of it, and its pictures.

    What is computed once for all sections is here.
    """

    design: Design
    digest: str
    scene: Scene
    pictures: Mapping[str, Inline]

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

    @property
    def key(self) -> str:
        """How links call it."""
        return self.template.removesuffix(".html").split("/")[-1]
