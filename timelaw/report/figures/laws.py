"""The laws as bars over one time: their legs in turn, their rests, and the time that no law beats."""

from typing import Any

import numpy as np

from timelaw.pipeline import Certified
from timelaw.report.figures.binding import fill_stretches
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.style import (
    DASHED,
    DWELL,
    LIMIT,
    OPTIMISED,
    SIZE,
    Canvas,
    set_ticks,
    stack_panels,
    write_title,
)
from timelaw.report.figures.time_scale import mark_seconds
from timelaw.report.numbers import write_number

HEIGHT = 0.18  # inch, of a bar
TOLD_APART = 60  # legs; more are one colour
NOTICEABLE = 1e-6  # relative; rest that is less of the time is not told


def draw_laws(scene: Scene, canvas: Canvas, least: float | None = None) -> Any:
    """A bar for each law, all in the same seconds; `least` [s] is marked by a line through all."""
    laws = (scene.optimised, *scene.baselines)
    end = max(entry.law.duration for entry in laws)
    figure, axes = stack_panels(canvas, [HEIGHT] * len(laws))
    for entry, ax in zip(laws, axes, strict=True):
        colour = OPTIMISED if entry is scene.optimised else scene.choose_colour(entry.name)
        _draw_bar(ax, entry, colour)
        write_title(ax, [entry.name], _say_time(entry))
        ax.set_xlim(0, end)
        ax.set_ylim(0, 1)
        ax.set_xticks([])
        ax.set_yticks([])
        for side in ("left", "bottom"):
            ax.spines[side].set_visible(side == "bottom" and ax is axes[-1])
        if least:
            ax.axvline(least, color=LIMIT, linewidth=1.0, linestyle=DASHED)
    set_ticks(axes[-1])
    mark_seconds(axes[-1], canvas, 0.0, end)
    axes[-1].set_xlabel("time, s" + ("; dashed: the physical limit" if least else ""), fontsize=SIZE)
    return figure


def _draw_bar(ax: Any, entry: Certified, colour: str) -> None:
    """Every second leg paler, where legs can be told apart; rest is shaded."""
    law = entry.law
    moving = np.array([segment.moves for segment in law.segments])
    even = np.cumsum(moving) % 2 == 1
    fill_stretches(ax, law.times, ~moving, DWELL, 1.0)
    if len(law.legs) > TOLD_APART:
        even = moving
    fill_stretches(ax, law.times, moving & even, colour, 1.0)
    fill_stretches(ax, law.times, moving & ~even, colour, 0.6)


def _say_time(entry: Certified) -> str:
    motion = sum(leg.duration for leg in entry.law.legs)
    total = entry.law.duration
    if motion < total * (1 - NOTICEABLE):
        return f"{write_number(total)} s, in motion {write_number(motion)} s"
    return f"{write_number(total)} s"
