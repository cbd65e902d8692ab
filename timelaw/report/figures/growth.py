"""The picture of growth: CPU time against size, both on logarithmic scales."""

from collections.abc import Mapping, Sequence
from typing import Any

from timelaw.report.figures.front import COLOURS
from timelaw.report.figures.style import DASHED, MUTED, SIZE, render_svg, use_style

TITLE = "CPU time against size"
GUIDES = {1e-3: "1 ms for each", 1e-2: "10 ms for each"}


def draw_growth(lines: Mapping[str, Sequence[tuple[float, float]]]) -> str:
    """SVG text: (size, CPU time [s]) of each line with its points; dashed, what grows as the size does."""
    from matplotlib.figure import Figure

    with use_style():
        figure = Figure(figsize=(7.2, 4.4), layout="constrained")
        ax: Any = figure.subplots()
        for (label, points), colour in zip(lines.items(), COLOURS, strict=False):
            ax.plot(*zip(*points, strict=True), "o-", color=colour, markersize=4, linewidth=1.2, label=label)
        ax.set_xscale("log")
        ax.set_yscale("log")
        sizes = [size for points in lines.values() for size, _ in points]
        ends = [min(sizes), max(sizes)]
        for factor, label in GUIDES.items():
            times = [factor * end for end in ends]
            ax.plot(ends, times, color=MUTED, linewidth=0.8, linestyle=DASHED)
            ax.annotate(
                label,
                (ends[0], times[0]),
                (6, -2),
                textcoords="offset points",
                color=MUTED,
                va="top",
                fontsize=SIZE,
            )
        ax.set_xlabel("legs, or nodes of a tour")
        ax.set_ylabel("CPU time [s]")
        ax.set_title(TITLE, fontsize=9)
        ax.grid(visible=True, which="major", linewidth=0.3)
        figure.legend(loc="outside lower center", ncols=2)  # no corner is free of lines for all sizes
        return render_svg(figure, "growth")
