"""The registry of the report's pictures, by file name."""

from timelaw.pipeline import Design
from timelaw.report.figures.easings import draw_easings
from timelaw.report.figures.rates import draw_rates
from timelaw.report.figures.style import STYLE

FIGURES = {"rates.svg": draw_rates, "easings.svg": draw_easings}


def draw_figures(design: Design) -> dict[str, str]:
    """SVG texts by file name."""
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        return {name: draw(design) for name, draw in FIGURES.items()}
