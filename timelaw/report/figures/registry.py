"""The registry of the report's pictures, by file name: how each is drawn, and of which designs."""

from collections.abc import Callable

from timelaw.pipeline import Design
from timelaw.report.figures.easings import draw_easings
from timelaw.report.figures.passing import draw_passing
from timelaw.report.figures.rates import draw_rates
from timelaw.report.figures.style import STYLE

FIGURES: dict[str, tuple[Callable[[Design], str], Callable[[Design], bool]]] = {
    "rates.svg": (draw_rates, lambda _: True),
    "easings.svg": (draw_easings, lambda design: design.through is None),
    "passing.svg": (draw_passing, lambda design: design.through is not None),
}


def draw_figures(design: Design) -> dict[str, str]:
    """SVG texts by file name."""
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        return {name: draw(design) for name, (draw, applies) in FIGURES.items() if applies(design)}
