"""Easings u = f(τ) along Bézier curves, and how long each curve takes, over the quintic."""

from typing import Any

import numpy as np

from timelaw.easing import Profile
from timelaw.easing.smoothstep import control_points
from timelaw.pipeline_bezier import BezierDesign
from timelaw.report.figures.style import AXIS_COLOURS, MAX_LEGS, OPTIMISED, QUINTIC, STYLE, render_svg
from timelaw.time_law import baselines


def draw_curve_easings(design: BezierDesign) -> str:
    """SVG text: f(τ) and f'(τ) of each curve, and their durations."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(9.4, 3.1), layout="constrained")
        axes: Any = figure.subplots(1, 3, width_ratios=(1, 1, 1.2))
        tau = np.linspace(0.0, 1.0, 401)
        grey = Profile.single(control_points(baselines.PAPER_CONTINUITY))
        for ax, order, title in ((axes[0], 0, "u = f(τ)"), (axes[1], 1, "its slope f′(τ)")):
            if design.baselines:
                ax.plot(tau, grey(tau, order), color=QUINTIC, linewidth=1.1)
            for index, timing in enumerate(design.timings[:MAX_LEGS]):
                colour = AXIS_COLOURS[index % len(AXIS_COLOURS)]
                name = design.curves[index].name
                ax.plot(tau, timing.easing(tau, order), color=colour, linewidth=1.2, label=name)
            ax.set_title(title, fontsize=9)
            ax.set_xlabel("τ")
        if len(design.timings) <= len(AXIS_COLOURS):
            axes[0].legend(loc="lower right", fontsize=7.5)
        _durations(axes[2], design)
        return render_svg(figure, "easings")


def _durations(ax: Any, design: BezierDesign) -> None:
    curves = design.curves[:MAX_LEGS]
    place = np.arange(len(curves))
    for certified, colour, width in [
        *((b, QUINTIC, 0.8) for b in design.baselines),
        (design.optimised, OPTIMISED, 0.5),
    ]:
        ax.bar(place, [leg.duration for leg in certified.law.legs[:MAX_LEGS]], width=width, color=colour)
    ax.set_xticks(place, [curve.name for curve in curves], rotation=90, fontsize=7, parse_math=False)
    ax.set_title("duration of each curve [s]", fontsize=9)
