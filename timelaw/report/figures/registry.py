"""The registry of the report's pictures, by file name: how each is drawn, and of which designs."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from timelaw.pipeline import Design
from timelaw.report.figures.binding import draw_binding
from timelaw.report.figures.box import draw_box
from timelaw.report.figures.curve_easings import draw_curve_easings
from timelaw.report.figures.drawing import Drawing, describe_laws, describe_limits, describe_rates
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.easings import draw_easings
from timelaw.report.figures.laws import draw_laws
from timelaw.report.figures.overview import draw_overview
from timelaw.report.figures.passing import draw_passing
from timelaw.report.figures.rates import draw_rates
from timelaw.report.figures.style import NARROW, WIDE, Canvas, render_svg, use_style
from timelaw.report.figures.window import is_long


@dataclass(frozen=True)
class Picture:
    """How a picture is drawn, its title, what it shows in words, and of which designs there is one."""

    draw: Callable[[Scene, Canvas], Any]
    title: str
    describe: Callable[[Scene], str]
    applies: Callable[[Any], bool] = lambda _: True


def _draw_route_laws(scene: Scene, canvas: Canvas) -> Any:
    design: Design = scene.design
    return draw_laws(scene, canvas, design.limit)


RATES = Picture(draw_rates, "Rates over time", describe_rates)
OVERVIEW = Picture(
    draw_overview, "Rates of the whole motion", describe_rates, lambda design: is_long(design.optimised.law)
)
BINDING = Picture(draw_binding, "Where the limits bind", describe_limits)
TIMINGS = "The distinct easings and their slopes over the part of a leg's time, and the duration of each leg."
FIGURES: dict[str, Picture] = {
    "laws.svg": Picture(_draw_route_laws, "The laws side by side", describe_laws),
    "overview.svg": OVERVIEW,
    "rates.svg": RATES,
    "limits.svg": BINDING,
    "easings.svg": Picture(
        draw_easings, "Easings and durations", lambda _: TIMINGS, lambda design: design.through is None
    ),
    "passing.svg": Picture(
        draw_passing,
        "The way past the nodes",
        lambda _: (
            "The angle of the body to the arc of its leg over time, and of short motions the traces of "
            "the body axes on the sphere, along the arcs and as the body goes."
        ),
        lambda design: design.through is not None,
    ),
}
CURVE_FIGURES: dict[str, Picture] = {
    "laws.svg": Picture(draw_laws, "The laws side by side", describe_laws),
    "overview.svg": OVERVIEW,
    "rates.svg": RATES,
    "limits.svg": BINDING,
    "easings.svg": Picture(draw_curve_easings, "Easings and durations", lambda _: TIMINGS),
    "motion.svg": Picture(
        draw_box,
        "The body along its way",
        lambda _: (
            "The body as a box at instants along its motion, later ones darker, and its corners' paths."
        ),
        lambda design: design.optimised.law.shape is not None,
    ),
}


def draw_figures(scene: Scene, figures: Mapping[str, Picture]) -> dict[str, Drawing]:
    """The pictures that there are of a design, by file name."""
    found = {}
    with use_style():
        for name, picture in figures.items():
            if picture.applies(scene.design):
                wide, narrow = (render_svg(picture.draw(scene, c), name) for c in (WIDE, NARROW))
                found[name] = Drawing(picture.title, picture.describe(scene), wide, narrow)
    return found
