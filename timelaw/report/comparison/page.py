"""`compare.html`: laws over each other in one self-contained page, and its figures as files."""

from collections.abc import Sequence
from dataclasses import dataclass
from types import SimpleNamespace

from markupsafe import Markup

from timelaw.report.comparison.compared import Compared
from timelaw.report.comparison.criteria import Line, order_names, show_part
from timelaw.report.figures.drawing import describe_laws, describe_rates
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.laws import draw_laws
from timelaw.report.figures.rates import draw_rates
from timelaw.report.figures.registry import Picture, draw_figures
from timelaw.report.page import embed_pictures, list_picture_files, make_environment, render_page
from timelaw.report.sections.provenance import list_versions
from timelaw.report.sections.rates import describe_pictures

FIGURES = {
    "compare-laws.svg": Picture(draw_laws, "The laws side by side", describe_laws),
    "compare-rates.svg": Picture(draw_rates, "Rates over time", describe_rates),
}
SECTIONS = (
    ("", "verdict", "comparison/verdict.html"),
    ("Side by side", "laws", "comparison/laws.html"),
    ("Rankings", "rankings", "comparison/rankings.html"),
    ("Rates over time", "rates", "comparison/rates.html"),
    ("Limits", "limits", "comparison/limits.html"),
    ("Provenance", "provenance", "comparison/provenance.html"),
)


@dataclass(frozen=True)
class Comparison:
    """Laws, their criteria, and what differs: of their routes from the first's, and in their settings."""

    laws: Sequence[Compared]
    lines: Sequence[Line]
    routes: Sequence[str]
    settings: Sequence[str]

    @property
    def names(self) -> list[str]:
        """Of the laws, in their order."""
        return [law.entry.name for law in self.laws]


def render_comparison(comparison: Comparison) -> dict[str, str]:
    """Texts by file name: compare.html and its figures."""
    entries = [law.entry for law in comparison.laws]
    drawn = SimpleNamespace(optimised=entries[0], baselines=tuple(entries[1:]))
    drawings = draw_figures(Scene(drawn), FIGURES)
    context = {
        "comparison": comparison,
        "entries": entries,
        "names": comparison.names,
        "pictures": embed_pictures(drawings),
        "parts": [
            [show_part(line.difference(k)).replace("-", "−") or "—" for k in range(1, len(entries))]
            for line in comparison.lines
        ],
        "orders": [order_names(line, comparison.names) for line in comparison.lines],
        "versions": list_versions(),
        **describe_pictures(entries[0]),
    }
    environment = make_environment()
    sections = [
        (title, key, Markup(environment.get_template(template).render(**context)))
        for title, key, template in SECTIONS
    ]
    page = render_page(environment, f"{' · '.join(comparison.names)}: timelaw compare", sections)
    return {"compare.html": page, **list_picture_files(drawings)}
