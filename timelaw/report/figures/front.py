"""The picture of a study: total time against effort, point by point."""

from collections.abc import Mapping, Sequence
from typing import Any

from timelaw.objectives import EFFORTS
from timelaw.report.figures.style import AXIS_COLOURS, OPTIMISED, render_svg, use_style

COLOURS = (OPTIMISED, "#b07400", AXIS_COLOURS[2], "#7a3f9d", "#5c5c61", AXIS_COLOURS[0])
MOST_NAMED = 20  # lines; a longer list leaves no room for them, and the table has all


def draw_front(name: str, effort: str, groups: Mapping[str, Sequence[tuple[float, float]]]) -> str:
    """SVG text: (time [s], effort) of each group as a line with its points, effort on a logarithmic scale.

    Many groups are drawn without their names.
    """
    from matplotlib.figure import Figure

    with use_style():
        figure = Figure(figsize=(7.2, 4.4), layout="constrained")
        ax: Any = figure.subplots()
        for index, (label, points) in enumerate(groups.items()):
            ordered = sorted(points)
            colour = COLOURS[index % len(COLOURS)]
            ax.plot(*zip(*ordered, strict=True), "o-", color=colour, markersize=4, linewidth=1.2, label=label)
        ax.set_yscale("log")
        ax.set_xlabel("total time [s]")
        ax.set_ylabel(f"{effort} effort [{EFFORTS[effort].unit}]")
        ax.set_title(name, fontsize=9, parse_math=False)
        ax.grid(visible=True, which="both", linewidth=0.3, color="#dddddd")
        if any(groups) and 1 < len(groups) <= MOST_NAMED:
            legend = ax.legend()
            for text in legend.get_texts():
                text.set_parse_math(False)
        return render_svg(figure, name)
