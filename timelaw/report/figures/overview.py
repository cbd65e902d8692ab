"""The whole of a long motion: least and greatest value on each few segments, so that no peak is left out."""

from typing import Any

import numpy as np

from timelaw.numerics.array import Array
from timelaw.report.figures.channels import Trace, trace_channel
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.rates import draw_bounds, find_top, say_peak, set_range
from timelaw.report.figures.style import (
    AXIS_COLOURS,
    HERE,
    MUTED,
    OPTIMISED,
    SIZE,
    Canvas,
    stack_panels,
    write_title,
)
from timelaw.report.figures.time_scale import TimeScale
from timelaw.report.figures.window import is_long, name_window

HEIGHT = 0.95  # inch, of a panel
STEP = 3  # points, the least width of a step


def draw_overview(scene: Scene, canvas: Canvas) -> Any:
    """A panel for each quantity, steps from the least to the greatest value on each segment, or each few."""
    law = scene.law
    channels, scale, window = scene.channels, TimeScale(law.segments), scene.window
    figure, axes = stack_panels(canvas, [HEIGHT] * len(channels))
    for channel, ax in zip(channels, axes, strict=True):
        trace = trace_channel(channel, scene.whole)
        top = find_top(law, trace)
        draw_envelope(ax, trace, scale, canvas)
        draw_bounds(ax, law, trace, scale, top)
        set_range(ax, trace, top)
        ax.set_xlim(0, scale.end)
        ax.set_xticks([])
        ends = scale([window[0].start_time, window[-1].end_time])
        if is_long(law):
            ax.axvspan(*ends, color=HERE, linewidth=0, zorder=-2)
        write_title(ax, channel.name_panel(top), say_peak(scene, channel), "xyz" if channel.signed else "")
    scale.mark(axes[-1], canvas, scale.end)
    axes[-1].set_xlabel(f"time, s ({len(law.legs)} legs; shaded: {name_window(law, window)})", fontsize=SIZE)
    return figure


def draw_envelope(ax: Any, trace: Trace, scale: TimeScale, canvas: Canvas) -> None:
    """Norms as steps from zero; components as bands, the norm as a line above them."""
    firsts = group_segments(len(trace.segments), canvas)
    edges = scale(scale.times)[[*firsts, len(trace.segments)]]
    norms = np.maximum.reduceat(trace.largest_norms(), firsts)
    if not trace.channel.signed:
        fill_steps(ax, edges, np.zeros(len(norms)), norms, OPTIMISED, 0.75)
        return
    ax.stairs(norms, edges, color=MUTED, linewidth=0.5, baseline=None)
    least, most = trace.envelope()
    low, high = np.minimum.reduceat(least, firsts), np.maximum.reduceat(most, firsts)
    for colour, below, above in zip(AXIS_COLOURS, low.T, high.T, strict=True):
        fill_steps(ax, edges, below, above, colour, 0.3)


def group_segments(count: int, canvas: Canvas) -> list[int]:
    """The first of each few neighbours that are one step, so that steps can be told apart."""
    many = -(-count * STEP // int(canvas.width * 72))
    return list(range(0, count, max(many, 1)))


def fill_steps(ax: Any, edges: Array, low: Array, high: Array, colour: str, alpha: float) -> None:
    """Bands between two staircases, as one path."""
    places = np.repeat(edges, 2)[1:-1]
    ax.fill_between(places, np.repeat(low, 2), np.repeat(high, 2), color=colour, alpha=alpha, linewidth=0)
