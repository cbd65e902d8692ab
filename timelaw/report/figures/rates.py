"""Rates, torque and momentum over time, with limits, nodes and rest: all of it, or its tightest part."""

from collections.abc import Sequence
from math import inf, isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array
from timelaw.report.figures.channels import Channel, Trace, find_power, trace_channel
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.style import (
    AXIS_COLOURS,
    DASHED,
    DWELL,
    LIMIT,
    MUTED,
    NODE,
    OPTIMISED,
    SIZE,
    Canvas,
    fit_text,
    measure_text,
    set_ticks,
    stack_panels,
    write_title,
)
from timelaw.report.figures.time_scale import TimeScale, choose_labels
from timelaw.report.figures.window import name_window
from timelaw.report.numbers import write_number

HEIGHT = 1.25  # inch, of a panel
ROOM = 1.08  # of the largest that is drawn
FAR = 1.6  # times the law's own peak; a limit or baseline beyond is not drawn, or cut
LONGER = 1.45  # times the law; a baseline that takes longer is cut there
LONGEST_LABEL = 76.0  # points; longer names are cut, so that the first has room beside the panel
KEY = 34.0  # points, of a line of the legend and the blanks around it


def draw_rates(scene: Scene, canvas: Canvas) -> Any:
    """A panel for each quantity: the law over its baselines, in the scale of the law."""
    law, window, channels = scene.law, scene.window, scene.channels
    texts, columns = _name_laws(scene, canvas)
    lines = -(-len(texts) // columns)
    figure, axes = stack_panels(canvas, [HEIGHT] * len(channels), top=0.28 + 0.2 * lines)
    scale = TimeScale(window)
    longest = [min(TimeScale(part.segments).end, LONGER * scale.end) for _, part in scene.beside]
    end = max([scale.end, *longest])
    for channel, ax in zip(channels, axes, strict=True):
        trace = trace_channel(channel, scene.part)
        top = find_top(law, trace)
        for name, part in scene.beside:
            _draw_baseline(ax, trace_channel(channel, part), scene.choose_colour(name), end)
        draw_trace(ax, trace, scale)
        draw_bounds(ax, law, trace, scale, top)
        _mark_nodes(ax, scene, window, scale)
        set_range(ax, trace, top)
        ax.set_xlim(0, end)
        ax.set_xticks([])
        write_title(ax, channel.name_panel(top), say_peak(scene, channel), "xyz" if channel.signed else "")
    scale.mark(axes[-1], canvas, end)
    axes[-1].set_xlabel("time, s", fontsize=SIZE)
    _label_nodes(axes[0], window, scale, end, canvas)
    named = name_window(law, window)
    if named:
        axes[-1].set_xlabel(f"time, s ({named})", fontsize=SIZE)
    _legend(figure, scene, canvas, texts, columns)
    return figure


def find_top(law: QuaternionLaw, trace: Trace) -> float:
    """The largest that the panel has to hold: of the law, and of its limits where they are not far."""
    peak = trace.largest()
    near = [b for b in _list_bounds(law, trace) if b <= FAR * peak or not peak]
    return max([peak, *near]) or 1.0


def _list_bounds(law: QuaternionLaw, trace: Trace) -> list[float]:
    """The bounds that are shown, on the norm and on components."""
    found = [trace.channel.bound_on(law, segment) for segment in trace.segments if segment.moves]
    return [float(b) for norm, axes in found for b in (norm, *axes) if isfinite(b)]


def _draw_baseline(ax: Any, trace: Trace, colour: str, end: float) -> None:
    """Its norm, from where its first leg begins, or its components where these are what is limited."""
    places = TimeScale(trace.segments)(trace.times)
    here = places <= end
    curves = trace.values.T if trace.channel.signed else [trace.norm]
    for values in curves:
        ax.plot(places[here], values[here], color=colour, linewidth=0.7, alpha=0.7)


def draw_trace(ax: Any, trace: Trace, scale: TimeScale) -> None:
    """The norm, or its components with the norm thin beside them."""
    places = scale(trace.times)
    if not trace.channel.signed:
        ax.plot(places, trace.norm, color=OPTIMISED, linewidth=1.5)
        return
    ax.plot(places, trace.norm, color=MUTED, linewidth=0.7, linestyle=(0, (1, 1.5)))
    for colour, values in zip(AXIS_COLOURS, trace.values.T, strict=True):
        ax.plot(places, values, color=colour, linewidth=1.3)


def draw_bounds(ax: Any, law: QuaternionLaw, trace: Trace, scale: TimeScale, top: float) -> None:
    """The limits leg by leg, on both sides where they are on components; a far one in words."""
    found = [trace.channel.bound_on(law, segment) for segment in trace.segments]
    edges = scale(scale.times)
    norms = np.array([norm if s.moves else inf for (norm, _), s in zip(found, trace.segments, strict=True)])
    axes = np.array(
        [axis if s.moves else np.full(3, inf) for (_, axis), s in zip(found, trace.segments, strict=True)]
    )
    alike = bool(np.all(axes == axes[:, :1]))
    lines = [(norms, LIMIT), *((axes[:, i], LIMIT if alike else c) for i, c in enumerate(AXIS_COLOURS))]
    for bounds, colour in lines[: 2 if alike else 4]:
        shown = bounds <= top * (1 + 1e-9)
        for first, last in _list_stretches(bounds, shown):
            for sign in (1, -1) if trace.channel.signed else (1,):
                level = sign * bounds[first]
                ax.plot(
                    [edges[first], edges[last]], [level, level], color=colour, linewidth=0.9, linestyle=DASHED
                )


def _list_stretches(bounds: Array, shown: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Ranges of segments that have the same bound; rests between are drawn through."""
    found: list[list[int]] = []
    for index in np.flatnonzero(shown).tolist():
        if (
            found
            and bounds[found[-1][0]] == bounds[index]
            and not np.any(np.isfinite(bounds[found[-1][1] : index]) & ~shown[found[-1][1] : index])
        ):
            found[-1][1] = index + 1
        else:
            found.append([index, index + 1])
    return [(first, last) for first, last in found]


def set_range(ax: Any, trace: Trace, top: float) -> None:
    """From zero, or to both sides, so far as the law and its limits go."""
    from matplotlib.ticker import MaxNLocator

    ax.set_ylim(-ROOM * top if trace.channel.signed else 0.0, ROOM * top)
    ax.yaxis.set_major_locator(MaxNLocator(4, symmetric=trace.channel.signed))
    set_ticks(ax, find_power(top))
    if trace.channel.signed:
        ax.axhline(0, color=NODE, linewidth=0.6, zorder=0)


def say_peak(scene: Scene, channel: Channel) -> str:
    """The proved peak beside its limit: the one that is used most."""
    checks = [
        check for check in scene.optimised.certificate.limits if check.limit.split(" ")[0] == channel.name
    ]
    if not checks:
        return "no limit"
    check = max(checks, key=lambda c: c.ratio)
    axis = check.limit.removeprefix(channel.name).strip()
    shown = f"{axis}: " if axis else ""
    peak, bound = (write_number(channel.scale * value) for value in (check.upper, check.bound))
    return f"{shown}at most {peak} of {bound}"


def _mark_nodes(ax: Any, scene: Scene, window: Sequence[Segment], scale: TimeScale) -> None:
    """Lines at the nodes, dotted where the body goes on; rest is shaded."""
    for segment in window:
        if not segment.moves:
            ax.axvspan(*scale([segment.start_time, segment.end_time]), color=DWELL, linewidth=0, zorder=-1)
    for node in scene.optimised.certificate.continuity.nodes:
        if window[0].start_time <= node.time <= window[-1].end_time:
            style = (0, (1, 2)) if node.passed else "-"
            ax.axvline(scale(node.time), color=NODE, linewidth=0.7, linestyle=style, zorder=0)


def _label_nodes(ax: Any, window: Sequence[Segment], scale: TimeScale, end: float, canvas: Canvas) -> None:
    """Labels of the nodes on a line above the first panel, as many as do not touch."""
    legs = [segment for segment in window if segment.moves]
    labels = [fit_text(label, LONGEST_LABEL) for label in (legs[0].origin, *(leg.target for leg in legs))]
    places = scale([legs[0].start_time, *(leg.end_time for leg in legs)])
    for index in choose_labels(labels, places, end, canvas):
        ax.annotate(
            labels[index],
            (places[index], 1),
            xycoords=("data", "axes fraction"),
            xytext=(0, 17),
            textcoords="offset points",
            ha="center",
            fontsize=SIZE,
            color=MUTED,
            parse_math=False,
        )


def _name_laws(scene: Scene, canvas: Canvas) -> tuple[list[str], int]:
    """The laws with their times, and how many of them fit in a line above the panels."""
    room = canvas.width * 72 - 2 * KEY
    laws = (scene.optimised, *scene.baselines)
    times = [f" {write_number(entry.law.duration)} s" for entry in laws]
    texts = [
        fit_text(entry.name, room - KEY - measure_text(time)) + time
        for entry, time in zip(laws, times, strict=True)
    ]
    return texts, max(1, min(len(texts), int(room // (max(map(measure_text, texts)) + KEY))))


def _legend(figure: Any, scene: Scene, canvas: Canvas, texts: Sequence[str], columns: int) -> None:
    """Which line is which law."""
    from matplotlib.lines import Line2D

    styles = [(OPTIMISED, 1.6), *((scene.choose_colour(b.name), 0.9) for b in scene.baselines)]
    handles = [Line2D([], [], color=colour, linewidth=width) for colour, width in styles]
    legend = figure.legend(
        handles,
        texts,
        loc="upper left",
        bbox_to_anchor=(0.1 / canvas.width, 1),
        ncols=columns,
        fontsize=SIZE,
        handlelength=1.4,
        columnspacing=1.2,
        borderaxespad=0.2,
    )
    for text in legend.get_texts():
        text.set_parse_math(False)
