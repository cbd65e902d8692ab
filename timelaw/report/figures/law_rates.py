"""The rates of one law over time: sizes and components, with the limits that hold throughout."""

from typing import TYPE_CHECKING, Any

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.report.figures.style import AXIS_COLOURS, LIMIT, NODE, SIZES, STYLE, UNITS

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Figure

ORDERS = (1, 2, 3)
NORM = "#202124"
POINTS = 60  # of each segment, breaks looked at from inside
NAMES = {1: "velocity", 2: "acceleration", 3: "jerk"}  # of the limits


def plot_law(law: QuaternionLaw) -> "Figure":
    """Three panels: the norm in black, components along the body axes in colours, limits on norms dashed."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(9.4, 6.0), layout="constrained")
        axes: Any = figure.subplots(len(ORDERS), 1, sharex=True)
        for order, ax in zip(ORDERS, axes, strict=True):
            _draw(ax, law, order)
        axes[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, fontsize=8, borderaxespad=0)
        axes[-1].set_xlabel("time [s]")
        axes[0].set_title(f"{law.name}, {law.duration:.6g} s", fontsize=9, loc="left")
    return figure


def _draw(ax: Any, law: QuaternionLaw, order: int) -> None:
    tau = np.linspace(0.0, 1.0, POINTS)
    times = np.concatenate([s.start_time + s.duration * tau for s in law.segments])
    rates = np.degrees(np.concatenate([s(tau, order, "right") for s in law.segments]))
    for axis, colour in enumerate(AXIS_COLOURS):
        ax.plot(times, rates[:, axis], color=colour, linewidth=0.8, label="xyz"[axis])
    ax.plot(times, np.linalg.norm(rates, axis=1), color=NORM, linewidth=1.4, label="norm")
    bound = law.limits.get(NAMES[order])
    if isinstance(bound, float):
        ax.axhline(np.degrees(bound), color=LIMIT, linewidth=0.8, linestyle="--")
    for node in law.times:
        ax.axvline(node, color=NODE, linewidth=0.4)
    ax.set_ylabel(f"{SIZES[order].strip('|')}  [{UNITS[order]}]")
    ax.margins(x=0.005)
