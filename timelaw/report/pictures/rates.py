"""ω, α and jerk of a law alone over time: their components in body axes, their size, and the limit on it."""

from typing import Any

import numpy as np

from timelaw.limits.row import ORDERS
from timelaw.motion import QuaternionLaw
from timelaw.motion.segment import RATES
from timelaw.report.figures.samples import sample_motion
from timelaw.report.figures.style import AXIS_COLOURS, GRID_LINE, INK, MUTED
from timelaw.report.pictures.sketch import SIZE

SYMBOLS = {1: "ω  [deg/s]", 2: "α  [deg/s²]", 3: "jerk  [deg/s³]"}
WIDE, PANEL = 7.2, 1.75  # inch
MANY = 60  # segments; nodes of more are no lines


def draw_rates(law: QuaternionLaw) -> Any:
    """Figure of three panels; both sides of every jump are drawn."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDE, 0.7 + PANEL * len(SYMBOLS)), layout="constrained")
    axes: Any = figure.subplots(len(SYMBOLS), 1, sharex=True)
    samples = sample_motion(law, law.segments)
    for ax, (order, symbol) in zip(axes, SYMBOLS.items(), strict=True):
        degrees = np.degrees(samples.rates[order])
        for axis, colour in enumerate(AXIS_COLOURS):
            label = f"body axis {'xyz'[axis]}"
            ax.plot(samples.times, degrees[axis], color=colour, linewidth=0.9, label=label)
        ax.plot(samples.times, np.linalg.norm(degrees, axis=0), color=INK, linewidth=1.2, label="size")
        _draw_limit(ax, law, order)
        if len(law.segments) <= MANY:
            for time in law.times:
                ax.axvline(time, color=GRID_LINE, linewidth=0.6, zorder=0)
        ax.axhline(0.0, color=GRID_LINE, linewidth=0.6, zorder=0)
        ax.set_ylabel(symbol, fontsize=SIZE)
        ax.tick_params(labelsize=SIZE, width=0.6, length=2.5)
        ax.margins(x=0.005)
    axes[-1].set_xlabel("time [s]", fontsize=SIZE)
    axes[0].legend(loc="lower left", bbox_to_anchor=(0, 1.02), ncols=5, borderaxespad=0, fontsize=SIZE)
    return figure


def _draw_limit(ax: Any, law: QuaternionLaw, order: int) -> None:
    """The law's limit on the size of that rate, or on its components by axis, on both sides."""
    name = next(name for name, k in ORDERS.items() if k == order)
    given = law.limits.get(name)
    if given is None:
        return
    bounds = {given: MUTED} if isinstance(given, float) else dict(zip(given, AXIS_COLOURS, strict=True))
    label = "limit"
    for bound, colour in bounds.items():
        for sense in (1.0, -1.0):
            ax.axhline(
                sense * np.degrees(bound), color=colour, linewidth=0.9, linestyle=(0, (5, 3)), label=label
            )
            label = "_"


def describe_rates(law: QuaternionLaw) -> str:
    """What is seen, for who does not see it."""
    largest = np.degrees(law.find_largest())
    peaks = ", ".join(
        f"|{RATES[k]}| up to {largest[k - 1]:.4g} {SYMBOLS[k].split('[')[1][:-1]}" for k in SYMBOLS
    )
    return f"The rates in body axes and their sizes over {law.duration:.6g} s: {peaks}."
