"""What all pictures have in common: colours, fonts, canvases, and how a figure becomes an SVG text."""

import io
import re
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

INK, MUTED, LINE, PAPER = "#1d1d1f", "#5c5c61", "#d9d9de", "#ffffff"
OPTIMISED, QUINTIC, DOUBLE_S, EVERY_STOP, STOPPING = "#0b5fa5", "#8c8c91", "#8a5a00", "#bd8f45", "#7a3f9d"
LIMIT, NODE, DWELL = "#3a3a3e", "#c9c9ce", "#eef0f2"
AXIS_COLOURS = ("#b3261e", "#1660b0", "#1b6e3c")  # body axes x, y, z as the printed paper has them
GRID_LINE, HERE = "#d5d5d8", "#f3e6c4"  # of globes; behind the part that is drawn in full
OMEGA = "#8a5200"  # the angular velocity as an arrow, and a route on S³
STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "text.color": INK,
    "axes.labelcolor": INK,
    "axes.edgecolor": MUTED,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "svg.fonttype": "none",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "grid.color": GRID_LINE,
    "lines.solid_joinstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "figure.facecolor": PAPER,
    "axes.facecolor": "none",
}
BINDING = {
    "velocity": "#2f6fb5",
    "acceleration": "#a86a00",
    "jerk": "#7d43a0",
    "snap": "#22784a",
    "torque": "#b8392f",
    "momentum": "#0e7377",
    "linear_velocity": "#4c66a5",
    "linear_acceleration": "#96563c",
}
OTHER = "#6a6a70"
THEME = {  # the names that colours have in a page, which has others in the dark
    INK: "ink",
    MUTED: "muted",
    LINE: "line",
    PAPER: "paper",
    OPTIMISED: "accent",
    QUINTIC: "quintic",
    DOUBLE_S: "double-s",
    EVERY_STOP: "every-stop",
    STOPPING: "stopping",
    LIMIT: "limit",
    NODE: "node",
    DWELL: "rest",
    GRID_LINE: "grid",
    HERE: "here",
    OTHER: "other",
    OMEGA: "axis-omega",
    **dict(zip(AXIS_COLOURS, ("axis-x", "axis-y", "axis-z"), strict=True)),
    **{colour: f"limit-{name.replace('_', '-')}" for name, colour in BINDING.items()},
}
# Text stays text, laid out by the measures of DejaVu Sans: these are as wide, or hardly wider.
FONTS = "'DejaVu Sans', 'Bitstream Vera Sans', Verdana, Geneva, sans-serif"
DASHED = (0, (5, 3))
SIZE = 8.5  # of labels, in points of the picture
BLANK = 4.0  # points
FULL_WIDTH = 0x2E80  # letters from here on are as wide as high


@dataclass(frozen=True)
class Canvas:
    """How wide a picture is [inch], and how many marks its time axis takes."""

    width: float
    ticks: int

    @property
    def wide(self) -> bool:
        """Whether it is for a screen or paper, not for a phone."""
        return self.width > NARROW.width


NARROW = Canvas(3.95, 5)
WIDE = Canvas(9.4, 10)
MARGINS = (0.56, 0.12)  # inch, left and right of panels
TITLE = 0.24  # inch above a panel, for its title


def stack_panels(
    canvas: Canvas, heights: list[float], top: float = 0.1, bottom: float = 0.42, between: float = 0.0
) -> Any:
    """A figure and its panels of some heights [inch] under each other; titles stand above them.

    `top`, `bottom` and `between` are room besides, above all, below all, and below each but the last.
    """
    from matplotlib.figure import Figure

    total = top + bottom + sum(heights) + TITLE * len(heights) + between * (len(heights) - 1)
    figure = Figure(figsize=(canvas.width, total))
    left, right = MARGINS
    wide = (canvas.width - left - right) / canvas.width
    axes, above = [], top
    for height in heights:
        above += TITLE + height
        axes.append(figure.add_axes((left / canvas.width, 1 - above / total, wide, height / total)))
        above += between
    return figure, axes


def lay_panels(canvas: Canvas, count: int, height: float, bottom: float = 0.28) -> Any:
    """A figure and its panels of one height [inch] beside each other, on a phone under each other."""
    from matplotlib.figure import Figure

    if not canvas.wide:
        return stack_panels(canvas, [height] * count, bottom=bottom, between=bottom)
    total = 0.1 + TITLE + height + bottom
    figure = Figure(figsize=(canvas.width, total))
    left, right = MARGINS
    share = canvas.width / count
    wide = (share - left - right) / canvas.width
    places = [(k * share + left) / canvas.width for k in range(count)]
    return figure, [figure.add_axes((place, bottom / total, wide, height / total)) for place in places]


def write_title(ax: Any, texts: Sequence[str], right: str = "", letters: str = "") -> None:
    """What a panel shows, above it: the first text that fits beside the remark on the right.

    After it letters in the colours of the body axes.
    """
    room = ax.get_position().width * ax.figure.get_figwidth() * 72
    wide = measure_text(right) + BLANK * 5 + sum(measure_text(letter) + BLANK * 2 for letter in letters)
    text = next((t for t in texts if measure_text(t) + wide <= room), fit_text(texts[-1], room - wide))
    style = {"xycoords": "axes fraction", "textcoords": "offset points", "fontsize": SIZE}
    ax.annotate(text, (0, 1), xytext=(0, 4), ha="left", color=INK, parse_math=False, **style)
    if right:
        ax.annotate(right, (1, 1), xytext=(0, 4), ha="right", color=MUTED, parse_math=False, **style)
    place = measure_text(text) + 2 * BLANK  # renderers differ a little in how wide texts are
    for letter, colour in zip(letters, AXIS_COLOURS, strict=False):
        ax.annotate(letter, (0, 1), xytext=(place, 4), ha="left", color=colour, weight="bold", **style)
        place += measure_text(letter) + BLANK * 2


def set_ticks(ax: Any, power: int = 0) -> None:
    """Short and thin, numbers as short as they may be, in a power of ten."""
    from matplotlib.ticker import FuncFormatter

    ax.tick_params(labelsize=SIZE, width=0.6, length=2.5)
    ax.yaxis.set_major_formatter(
        FuncFormatter(lambda value, _: f"{value / 10.0**power:.4g}".replace("-", "−"))
    )


def render_svg(figure: Any, salt: str) -> str:
    """The figure as SVG, the same text for the same figure."""
    import matplotlib as mpl
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    text = io.StringIO()
    with mpl.rc_context({"svg.hashsalt": salt}):
        canvas: Any = FigureCanvasSVG(figure)
        canvas.print_svg(text, metadata={"Date": None, "Creator": "timelaw"})
    found = text.getvalue().replace("'DejaVu Sans'", FONTS)
    return re.sub(r'(?<= d=")[^"]*', _round_path, found)


def _round_path(path: re.Match[str]) -> str:
    """Coordinates to a hundredth of a point, in one line."""
    return re.sub(r"(\.\d\d)\d+", r"\1", path[0]).replace(" \n", " ").strip()


def measure_text(text: str, size: float = SIZE) -> float:
    """How wide a text is [points]; letters that the font lacks, of the east most often, count as squares."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    known = "".join(letter for letter in text if ord(letter) < FULL_WIDTH)
    width, _, _ = text_to_path.get_text_width_height_descent(
        known or " ", FontProperties(family="DejaVu Sans", size=size), ismath=False
    )
    return float(width) + size * (len(text) - len(known))


@contextmanager
def use_style() -> Iterator[None]:
    """Inside, figures have our style; letters that the font lacks are the viewer's to find."""
    import matplotlib as mpl

    with mpl.rc_context(STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        yield


def fit_text(text: str, room: float) -> str:
    """The text, or as much of its beginning as has room [points], and an ellipsis."""
    cut = text
    while cut and measure_text(cut if cut == text else f"{cut}…") > room:
        cut = cut[:-1]
    return cut if cut == text else f"{cut}…"
