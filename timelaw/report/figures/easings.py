"""The distinct easings and their slopes, and the durations of the legs, beside those of the baselines."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from timelaw.easing import Profile
from timelaw.easing.smoothstep import control_points
from timelaw.numerics.array import Array
from timelaw.pipeline import Design
from timelaw.report.figures.drawn import SampledEasings, Scene
from timelaw.report.figures.style import (
    MARGINS,
    OPTIMISED,
    QUINTIC,
    Canvas,
    lay_panels,
    measure_text,
    set_ticks,
    write_title,
)
from timelaw.time_law import baselines

SINGLE = 24  # distinct easings that are drawn one by one; of more, the band that they fill
NAMED = 60  # legs that stand in their order; more are sorted
GAP = 5.0  # points between two labels


def draw_easings(scene: Scene, canvas: Canvas) -> Any:
    """The distinct easings f(τ) and f'(τ) over the smoothstep, and the durations of the legs."""
    design: Design = scene.design
    names = [leg.name for leg in design.route.legs]
    easings = scene.sample_easings(design.solution.timings)
    return draw_timings(scene, easings, names, ("easing f(τ)", "its slope f′(τ)"), canvas)


def draw_timings(
    scene: Scene, easings: SampledEasings, names: Sequence[str], titles: tuple[str, str], canvas: Canvas
) -> Any:
    """Easings and their slopes, in two panels, and how long each leg takes, in a third."""
    figure, axes = lay_panels(canvas, 3, 1.7)
    tau = easings.tau
    grey = Profile.single(control_points(baselines.PAPER_CONTINUITY))
    for ax, order, title in zip(axes, (0, 1), titles, strict=False):
        if any(b.name == baselines.QUINTIC for b in scene.baselines):
            ax.plot(tau, grey(tau, order), color=QUINTIC, linewidth=1.1)
        draw_curves(ax, tau, easings.values[order])
        write_title(ax, [title], f"{len(easings.values[0])} distinct" if order == 0 else "")
        ax.set_xticks([0, 0.5, 1], ["0", "0.5", "τ = 1"])
        set_ticks(ax)
    draw_durations(axes[2], scene, names)
    return figure


def draw_curves(ax: Any, tau: Array, values: Array) -> None:
    """A few, each over τ, one by one; of many the band between least and greatest, and their median."""
    if len(values) <= SINGLE:
        for value in values:
            ax.plot(tau, value, color=OPTIMISED, linewidth=1.2, alpha=0.75)
        return
    ax.fill_between(tau, values.min(axis=0), values.max(axis=0), color=OPTIMISED, alpha=0.3, linewidth=0)
    ax.plot(tau, np.median(values, axis=0), color=OPTIMISED, linewidth=1.3)


def draw_durations(ax: Any, scene: Scene, names: Sequence[str]) -> None:
    """Steps of the law, filled, and of every baseline; of many legs from the longest to the shortest."""
    many = len(names) > NAMED
    edges = np.arange(len(names) + 1.0)
    for entry in (scene.optimised, *scene.baselines):
        durations = np.array([leg.duration for leg in entry.law.legs])
        if len(durations) != len(names):
            continue
        steps = -np.sort(-durations) if many else durations
        if entry is scene.optimised:
            ax.stairs(steps, edges, fill=True, color=OPTIMISED, alpha=0.75)
        else:
            ax.stairs(steps, edges, color=scene.choose_colour(entry.name), linewidth=1.0, baseline=None)
    write_title(ax, ["duration of each leg, s"], "sorted" if many else "")
    ax.set_xlim(0, len(names))
    ax.set_ylim(bottom=0)
    set_ticks(ax)
    if many:
        ax.set_xticks([0, len(names)], ["longest", f"{len(names)} legs"])
        ax.get_xticklabels()[0].set_horizontalalignment("left")
        ax.get_xticklabels()[1].set_horizontalalignment("right")
        return
    kept = _choose(ax, names)
    ax.set_xticks([k + 0.5 for k in kept], [names[k] for k in kept], parse_math=False)


def _choose(ax: Any, names: Sequence[str]) -> list[int]:
    """Names that can stand under their steps without touching."""
    points = ax.get_position().width * ax.figure.get_figwidth() * 72
    kept: list[int] = []
    free = -MARGINS[0] * 36
    for k, name in enumerate(names):
        middle, half = (k + 0.5) / len(names) * points, measure_text(name) / 2
        if middle - half >= free and middle + half <= points + MARGINS[1] * 72:
            kept.append(k)
            free = middle + half + GAP
    return kept
