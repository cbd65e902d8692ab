"""The distinct easings and their slopes, and the durations of the legs, over the quintic."""

from typing import Any

import numpy as np

from timelaw.easing import Profile
from timelaw.easing.smoothstep import control_points
from timelaw.pipeline import Design
from timelaw.report.figures.style import MAX_LEGS, OPTIMISED, QUINTIC, describe_excerpt, render_svg
from timelaw.time_law import baselines
from timelaw.time_law.time_law import OPTIMISED_LAW

BARS = {baselines.QUINTIC: (QUINTIC, 0.8), OPTIMISED_LAW: (OPTIMISED, 0.5)}


def draw_easings(design: Design) -> str:
    """The distinct easings f(τ) and f'(τ) over the smoothstep, and the durations of the segments."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.4, 3.1), layout="constrained")
    axes: Any = figure.subplots(1, 3, width_ratios=(1, 1, 1.5))
    tau = np.linspace(0.0, 1.0, 201)
    easings = [timing.easing for timing in design.solution.timings]
    for ax, order, title in ((axes[0], 0, "easing f(τ)"), (axes[1], 1, "its slope f′(τ)")):
        if any(b.name == baselines.QUINTIC for b in design.baselines):
            grey = Profile.single(control_points(baselines.PAPER_CONTINUITY))
            ax.plot(tau, grey(tau, order), color=QUINTIC, linewidth=1.1)
        for easing in {easing.key(): easing for easing in easings}.values():
            ax.plot(tau, easing(tau, order), color=OPTIMISED, linewidth=1.2, alpha=0.75)
        ax.set_title(title, fontsize=9)
        ax.set_xlabel("τ")
    _durations(axes[2], design)
    return render_svg(figure, "easings")


def _durations(ax: Any, design: Design) -> None:
    """Grey bars of the quintic, wherever it stands among the baselines, behind those of the law."""
    count = min(len(design.route.legs), MAX_LEGS)
    place = np.arange(count)
    for certified in design.laws[::-1]:
        if certified.name in BARS:
            colour, width = BARS[certified.name]
            ax.bar(place, [leg.duration for leg in certified.law.legs[:count]], width=width, color=colour)
    names = [leg.name for leg in design.route.legs[:count]]
    ax.set_xticks(place, names, rotation=90, fontsize=7, parse_math=False)
    ax.set_title("duration of each leg [s]" + describe_excerpt(design.optimised.law), fontsize=9)
