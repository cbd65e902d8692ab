"""The pictures of the report, as SVG texts. Matplotlib is imported here only, and only when one is drawn."""

import io
from math import inf
from typing import Any

import numpy as np

from timelaw.easing import Easing
from timelaw.easing.smoothstep import control_points
from timelaw.motion import QuaternionLaw
from timelaw.pipeline import Design
from timelaw.report.active_limits import trace_parts
from timelaw.report.curves import rate_curve
from timelaw.time_law.baselines import PAPER_CONTINUITY

OPTIMISED, QUINTIC, LIMIT, NODE, DWELL = "#0b5fa5", "#9b9b9b", "#b3261e", "#c9c9c9", "#eef0f2"
AXIS_COLOURS = ("#0b5fa5", "#b07400", "#1b6e3c")
MAX_LEGS = 24  # more legs than this would be a solid band; the first of them are drawn
MAX_LABELS = 30
RATE_NAMES = {1: "|ω|", 2: "|α|", 3: "|jerk|"}
UNITS = {1: "deg/s", 2: "deg/s²", 3: "deg/s³"}
STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "svg.fonttype": "path",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "lines.solid_joinstyle": "round",
    "legend.frameon": False,
}


def figures(design: Design) -> dict[str, str]:
    """SVG texts by file name."""
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        return {"rates.svg": _rates(design), "easings.svg": _easings(design)}


def _rates(design: Design) -> str:
    """|ω|, |α|, |jerk| over time, the optimised law over the grey quintic, with limits and nodes."""
    from matplotlib.figure import Figure

    law = design.optimised.law
    extra = [limit for limit in ("torque", "momentum") if limit in law.limits]
    figure = Figure(figsize=(9.4, 6.4 + 1.8 * len(extra)), layout="constrained")
    axes: Any = figure.subplots(3 + len(extra), 1, sharex=True)
    grey = next((b.law for b in design.baselines if b.name == "quintic"), None)
    for order, ax in zip((1, 2, 3), axes, strict=False):
        ax.set_ylabel(f"{RATE_NAMES[order]}  [{UNITS[order]}]")
        if grey is not None:
            _curve(ax, grey, order, QUINTIC, 1.1, f"quintic, {grey.duration:.6g} s")
        _curve(ax, law, order, OPTIMISED, 1.5, f"optimised, {law.duration:.6g} s")
        _limit(ax, design, order)
        _nodes(ax, design)
        ax.set_ylim(bottom=0)
        ax.margins(x=0.005)
    for limit, ax in zip(extra, axes[3:], strict=True):
        _parts(ax, law, limit)
        _nodes(ax, design)
    end = max(curve.segments[:MAX_LEGS][-1].end_time for curve in (law, grey or law))
    axes[0].set_xlim(-0.005 * end, 1.005 * end)
    axes[-1].set_xlabel("time [s]" + _excerpt(law))
    axes[0].legend(loc="lower left", bbox_to_anchor=(0, 1.12), ncols=3, borderaxespad=0)
    _labels(axes[0], design)
    return svg(figure, "rates")


def _parts(ax: Any, law: QuaternionLaw, limit: str) -> None:
    """The part of a limit that is used over time, axis by axis where it is given so."""
    ax.set_ylabel(f"{limit} / limit")
    curves = trace_parts(law, law.segments[:MAX_LEGS], limit)
    for colour, (label, (times, values)) in zip(AXIS_COLOURS, curves.items(), strict=False):
        ax.plot(times, values, color=colour if len(curves) > 1 else OPTIMISED, linewidth=1.3, label=label)
    ax.axhline(1.0, color=LIMIT, linewidth=1, linestyle=(0, (5, 3)))
    ax.set_ylim(0, 1.35)
    if len(curves) > 1:
        ax.legend(loc="upper right", ncols=3, fontsize=7.5, borderaxespad=0.1)


def _excerpt(law: QuaternionLaw) -> str:
    count = len(law.segments)
    return f", the first {MAX_LEGS} of {count} legs" if count > MAX_LEGS else ""


def _curve(ax: Any, law: QuaternionLaw, order: int, colour: str, width: float, label: str) -> None:
    times, values = rate_curve(law.segments[:MAX_LEGS], order)
    ax.plot(times, np.degrees(values), color=colour, linewidth=width, label=label)


def _limit(ax: Any, design: Design, order: int) -> None:
    """The bound on |k-th rate| leg by leg, one line through where it is the same for all."""
    style = {"color": LIMIT, "linewidth": 1, "linestyle": (0, (5, 3))}
    law = design.optimised.law
    arcs = [s for s in law.segments[:MAX_LEGS] if s.moves]
    bounds = [
        min((quantity.row.rate_bound(order) for quantity, _ in law.quantities(arc)), default=inf)
        for arc in arcs
    ]
    if len(set(bounds)) == 1 and bounds[0] < inf:
        ax.axhline(np.degrees(bounds[0]), label="limit", **style)
        return
    label = "limit"
    for arc, bound in zip(arcs, bounds, strict=True):
        if bound < inf:
            ax.plot([arc.start_time, arc.end_time], np.degrees([bound, bound]), label=label, **style)
            label = "_"


def _nodes(ax: Any, design: Design) -> None:
    """Lines at the nodes, dotted where the body goes straight on; dwells are shaded."""
    for segment in design.optimised.law.segments[:MAX_LEGS]:
        if not segment.moves:
            ax.axvspan(segment.start_time, segment.end_time, color=DWELL, linewidth=0, zorder=-1)
    for node in design.optimised.certificate.continuity.nodes[: MAX_LEGS + 1]:
        dotted = node.kind == "straight"
        ax.axvline(node.time, color=NODE, linewidth=0.7, linestyle=":" if dotted else "-", zorder=0)


def _labels(ax: Any, design: Design) -> None:
    """Node labels above the first panel, a dwell's once; a dot marks the nodes passed at speed."""
    last = None
    for node in design.optimised.certificate.continuity.nodes[: MAX_LEGS + 1][:MAX_LABELS]:
        if node.label == last:
            continue
        last = node.label
        text = f"·{node.label}·" if node.kind == "straight" else node.label
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


def _easings(design: Design) -> str:
    """The distinct easings f(τ) and f'(τ) over the smoothstep, and the durations of the segments."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.4, 3.1), layout="constrained")
    axes: Any = figure.subplots(1, 3, width_ratios=(1, 1, 1.5))
    tau = np.linspace(0.0, 1.0, 201)
    easings = [timing.easing for timing in design.solution.timings]
    for ax, order, title in ((axes[0], 0, "easing f(τ)"), (axes[1], 1, "its slope f′(τ)")):
        if any(b.name == "quintic" for b in design.baselines):
            grey = Easing.single(control_points(PAPER_CONTINUITY))
            ax.plot(tau, grey(tau, order), color=QUINTIC, linewidth=1.1)
        for easing in {easing.key(): easing for easing in easings}.values():
            ax.plot(tau, easing(tau, order), color=OPTIMISED, linewidth=1.2, alpha=0.75)
        ax.set_title(title, fontsize=9)
        ax.set_xlabel("τ")
    _durations(axes[2], design)
    return svg(figure, "easings")


def _durations(ax: Any, design: Design) -> None:
    count = min(len(design.route.legs), MAX_LEGS)
    place = np.arange(count)
    for entry, colour, width in ((design.baselines[:1], QUINTIC, 0.8), ((design.optimised,), OPTIMISED, 0.5)):
        for certified in entry:
            if certified.name in ("quintic", "optimised"):
                heights = [leg.duration for leg in certified.law.legs[:count]]
                ax.bar(place, heights, width=width, color=colour)
    names = [leg.name for leg in design.route.legs[:count]]
    ax.set_xticks(place, names, rotation=90, fontsize=7, parse_math=False)
    ax.set_title("duration of each leg [s]" + _excerpt(design.optimised.law), fontsize=9)


def svg(figure: Any, salt: str) -> str:
    """The figure as SVG, the same text for the same figure."""
    import matplotlib as mpl
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    text = io.StringIO()
    with mpl.rc_context({"svg.hashsalt": salt}):
        canvas: Any = FigureCanvasSVG(figure)
        canvas.print_svg(text, metadata={"Date": None, "Creator": "timelaw"})
    return text.getvalue()
