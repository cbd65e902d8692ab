"""What all pictures have in common: colours, fonts, and how a figure becomes an SVG text."""

import io
from typing import Any

from timelaw.motion import QuaternionLaw, Segment

OPTIMISED, QUINTIC, LIMIT, NODE, DWELL = "#0b5fa5", "#9b9b9b", "#b3261e", "#c9c9c9", "#eef0f2"
AXIS_COLOURS = ("#0b5fa5", "#b07400", "#1b6e3c")
MAX_LEGS = 24  # more legs than this would be a solid band; the first of them are drawn
MAX_LABELS = 30
SIZES = {1: "|ω|", 2: "|α|", 3: "|jerk|", 4: "|snap|"}
UNITS = {1: "deg/s", 2: "deg/s²", 3: "deg/s³", 4: "deg/s⁴"}
STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "svg.fonttype": "path",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "lines.solid_joinstyle": "round",
    "legend.frameon": False,
}


def render_svg(figure: Any, salt: str) -> str:
    """The figure as SVG, the same text for the same figure."""
    import matplotlib as mpl
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    text = io.StringIO()
    with mpl.rc_context({"svg.hashsalt": salt}):
        canvas: Any = FigureCanvasSVG(figure)
        canvas.print_svg(text, metadata={"Date": None, "Creator": "timelaw"})
    return text.getvalue()


def list_first_legs(law: QuaternionLaw) -> tuple[Segment, ...]:
    """The segments up to the last leg that is drawn, dwells between them included."""
    legs = law.legs[:MAX_LEGS]
    return law.segments if len(legs) == len(law.legs) else law.segments[: law.segments.index(legs[-1]) + 1]


def describe_excerpt(law: QuaternionLaw) -> str:
    """What to add to a title where only the first legs are drawn."""
    count = len(law.legs)
    return f", the first {MAX_LEGS} of {count} legs" if count > MAX_LEGS else ""
