"""Rates over time, and the used parts of torque and momentum, with limits, nodes and dwells."""

from math import inf
from typing import Any

import numpy as np

from timelaw.limits import LIMITS
from timelaw.motion import QuaternionLaw
from timelaw.motion.segment import RATES
from timelaw.report.active_limits import trace_parts
from timelaw.report.figures.curves import trace_rate
from timelaw.report.figures.drawn import Drawn
from timelaw.report.figures.style import (
    AXIS_COLOURS,
    DWELL,
    LIMIT,
    MAX_LABELS,
    NODE,
    OPTIMISED,
    QUINTIC,
    SIZES,
    UNITS,
    describe_excerpt,
    list_first_legs,
    render_svg,
)
from timelaw.time_law import baselines

ALWAYS = (1, 2, 3)  # orders that have a panel, limited or not


def draw_rates(design: Drawn) -> str:
    """|ω|, |α|, |jerk| over time, the optimised law over the grey quintic, with limits and nodes."""
    from matplotlib.figure import Figure

    law = design.optimised.law
    beyond = (name for name, kind in LIMITS.items() if kind.needs_inertia or kind.needs_translation)
    extra = [name for name in beyond if name in law.limits]
    orders = [order for order, name in RATES.items() if order in ALWAYS or name in law.limits]
    panels = len(orders) + len(extra)
    figure = Figure(figsize=(9.4, 1.0 + 1.8 * panels), layout="constrained")
    axes: Any = figure.subplots(panels, 1, sharex=True)
    grey = next((b.law for b in design.baselines if b.name == baselines.QUINTIC), None)
    for order, ax in zip(orders, axes, strict=False):
        ax.set_ylabel(f"{SIZES[order]}  [{UNITS[order]}]")
        if grey is not None:
            _curve(ax, grey, order, QUINTIC, 1.1, f"quintic, {grey.duration:.6g} s")
        _curve(ax, law, order, OPTIMISED, 1.5, f"optimised, {law.duration:.6g} s")
        _limit(ax, design, order)
        _nodes(ax, design)
        ax.set_ylim(bottom=0)
        ax.margins(x=0.005)
    for limit, ax in zip(extra, axes[len(orders) :], strict=True):
        _parts(ax, law, limit)
        _nodes(ax, design)
    end = max(list_first_legs(curve)[-1].end_time for curve in (law, grey or law))
    axes[0].set_xlim(-0.005 * end, 1.005 * end)
    axes[-1].set_xlabel("time [s]" + describe_excerpt(law))
    axes[0].legend(loc="lower left", bbox_to_anchor=(0, 1.12), ncols=3, borderaxespad=0)
    _labels(axes[0], design)
    return render_svg(figure, "rates")


def _parts(ax: Any, law: QuaternionLaw, limit: str) -> None:
    """The part of a limit that is used over time, axis by axis where it is given so."""
    ax.set_ylabel(f"{limit.replace('_', ' ')} / limit")
    curves = trace_parts(law, list_first_legs(law), limit)
    for colour, (label, (times, values)) in zip(AXIS_COLOURS, curves.items(), strict=False):
        ax.plot(times, values, color=colour if len(curves) > 1 else OPTIMISED, linewidth=1.3, label=label)
    ax.axhline(1.0, color=LIMIT, linewidth=1, linestyle=(0, (5, 3)))
    ax.set_ylim(0, 1.35)
    if len(curves) > 1:
        ax.legend(loc="upper right", ncols=3, fontsize=7.5, borderaxespad=0.1)


def _curve(ax: Any, law: QuaternionLaw, order: int, colour: str, width: float, label: str) -> None:
    times, values = trace_rate(list_first_legs(law), order)
    ax.plot(times, np.degrees(values), color=colour, linewidth=width, label=label)


def _limit(ax: Any, design: Drawn, order: int) -> None:
    """The bound on |k-th rate| leg by leg, one line through where it is the same for all."""
    style = {"color": LIMIT, "linewidth": 1, "linestyle": (0, (5, 3))}
    law = design.optimised.law
    arcs = [s for s in list_first_legs(law) if s.moves]
    bounds = [
        min((quantity.row.rate_bound(order) for _, quantity in labelled), default=inf)
        for labelled in law.list_quantities(arcs)
    ]
    if len(set(bounds)) == 1 and bounds[0] < inf:
        ax.axhline(np.degrees(bounds[0]), label="limit", **style)
        return
    label = "limit"
    for arc, bound in zip(arcs, bounds, strict=True):
        if bound < inf:
            ax.plot([arc.start_time, arc.end_time], np.degrees([bound, bound]), label=label, **style)
            label = "_"


def _nodes(ax: Any, design: Drawn) -> None:
    """Lines at the nodes, dotted where the body goes straight on; dwells are shaded."""
    for segment in list_first_legs(design.optimised.law):
        if not segment.moves:
            ax.axvspan(segment.start_time, segment.end_time, color=DWELL, linewidth=0, zorder=-1)
    for node in design.optimised.certificate.continuity.nodes[
        : len(list_first_legs(design.optimised.law)) + 1
    ]:
        style = ":" if node.passed else "-"
        ax.axvline(node.time, color=NODE, linewidth=0.7, linestyle=style, zorder=0)


def _labels(ax: Any, design: Drawn) -> None:
    """Node labels above the first panel, a dwell's once; a dot marks the nodes passed at speed."""
    last = None
    for node in design.optimised.certificate.continuity.nodes[
        : len(list_first_legs(design.optimised.law)) + 1
    ][:MAX_LABELS]:
        if node.label == last:
            continue
        last = node.label
        text = f"·{node.label}·" if node.passed else node.label
        ax.annotate(
            text,
            (node.time, 1),
            xycoords=("data", "axes fraction"),
            xytext=(0, 3),
            textcoords="offset points",
            ha="center",
            fontsize=7.5,
            color="#555555",
            parse_math=False,
        )
