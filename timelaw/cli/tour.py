"""`timelaw tour`: legs, turns, certificate and the time a tour allows, before any law is designed."""

from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from timelaw.cli.console import print_json, print_table, say, show_progress
from timelaw.errors import EXIT_DONE, InputError
from timelaw.export.orientations_csv import format_orientations
from timelaw.files import write_files
from timelaw.pipeline import Layout, lay_out
from timelaw.progress import tell
from timelaw.report.tour_text import describe_merits, list_merit_data, list_notes, measure_arcs
from timelaw.requirements.route_limit import find_route_limit
from timelaw.tours import sharpen
from timelaw.tours.straightest import STRAIGHT

PICTURE = ".svg"
MOST_LEGS, FIRST, LAST = 40, 12, 4  # of longer tours the first and last legs are printed
MOST_IN_TABLE = 1000  # orientations: a million distances


def run(problem: str, output: str | None, *, table: bool, as_json: bool, all_legs: bool = False) -> int:
    """Show the tour of a problem file; returns the exit code."""
    if output is not None and Path(output).suffix.lower() == PICTURE:
        raise InputError(
            f'-o "{output}": it names the orientation file, such as tour.csv; the picture goes beside it'
        )
    with show_progress() as report:
        layout = lay_out(problem, report)
        if table and len(layout.orientations) > MOST_IN_TABLE:
            count = len(layout.orientations)
            raise InputError(f"--table: {count} orientations; at most {MOST_IN_TABLE} fit in a table")
        layout = replace(layout, tour=sharpen(layout.tour, layout.orientations, report))
        tell(report, "times of the tour")
        found = _summary(layout)
    _print(layout, found, all_legs=all_legs)
    if table:
        _print_distances(layout)
    if output is not None:
        from timelaw.report.figures.sphere import draw_traces

        path = Path(output)
        table_text = format_orientations(layout.orientations, layout.tour, layout.route)
        picture = draw_traces(layout.problem.name, layout.route)
        write_files({path: table_text, path.with_suffix(PICTURE): picture})
        found["files"] = [str(path), str(path.with_suffix(PICTURE))]
        say(f"orientations in the tour's order: {path}; picture: {path.with_suffix(PICTURE)}")
    if as_json:
        print_json({"ok": True, "exit_code": EXIT_DONE, **found})
    return EXIT_DONE


def _summary(layout: Layout) -> dict[str, Any]:
    """Everything there is to say, in plain data; angles in degrees."""
    route, requirements = layout.route, layout.requirements
    inner = route.nodes[1:-1]
    return {
        "name": layout.problem.name,
        "closed": layout.tour.closed,
        "tour": [layout.orientations.labels[i] for i in layout.tour.order],
        "legs": [
            {"leg": leg.name, "angle": float(np.degrees(leg.angle)), "axis": leg.axis.tolist()}
            for leg in route.legs
        ],
        "turns": [{"node": n.label, "kind": n.kind, "turn": float(np.degrees(n.turn))} for n in inner],
        "length": float(np.degrees(layout.tour.length)),
        "total_turning": float(np.degrees(sum(n.turn for n in inner))),
        "straight_nodes": route.straight_nodes,
        "passed_nodes": len(route.legs) - len(requirements.runs(route)),
        "runs": [len(run.angles) for run in requirements.runs(route)],
        "is_shortest": layout.tour.is_shortest,
        "certificate": "; ".join(describe_merits(layout.tour)),
        "merits": [list_merit_data(merit) for merit in layout.tour.merits],
        "notes": list_notes(layout.orientations, route),
        "precision": {
            "angle": float(np.degrees(layout.orientations.precision.angle)),
            "origin": layout.orientations.precision.origin,
        },
        "moved": {label: float(np.degrees(angle)) for label, angle in route.moved.items()},
        "time_over_runs": find_route_limit(route, requirements),
        "time_with_every_stop": find_route_limit(route, requirements, stop=True),
    }


def _print(layout: Layout, found: dict[str, Any], *, all_legs: bool) -> None:
    nodes = layout.route.nodes
    rows = [
        [
            leg.name,
            f"{np.degrees(leg.angle):.4f}",
            ", ".join(f"{c:.4f}" for c in leg.axis) + (" (half-turn)" if leg.half_turn else ""),
            node.kind,
            f"{np.degrees(node.turn):.2f}" if node.kind in ("corner", "straight") else "",
        ]
        for leg, node in zip(layout.route.legs, nodes[1:], strict=True)
    ]
    left_out = 0 if all_legs or len(rows) <= MOST_LEGS else len(rows) - FIRST - LAST
    if left_out:
        rows = [*rows[:FIRST], [f"… {left_out} more", "", "", "", ""], *rows[-LAST:]]
    print_table(["leg", "angle [deg]", "axis (body)", "then", "axis turns [deg]"], rows)
    if left_out:
        say(_sum_up(layout))
    for line in (*found["notes"], *describe_merits(layout.tour)):
        say(line)
    passed = found["passed_nodes"]
    stopped = "" if passed == found["straight_nodes"] else f", {passed} of them without a stop"
    if not any(merit.name == STRAIGHT for merit in layout.tour.merits):
        say(
            f"{found['straight_nodes']} of {len(nodes) - 2} inner nodes go straight on{stopped}; "
            f"the axis turns by {found['total_turning']:.2f}° in all"
        )
    say(
        f"least time over the runs {found['time_over_runs']:.4f} s, "
        f"with a stop at every node {found['time_with_every_stop']:.4f} s"
    )


def _sum_up(layout: Layout) -> str:
    """All legs in a sentence: how long they are, and what the body does between them."""
    angles = np.degrees([leg.angle for leg in layout.route.legs])
    least, median, most = np.min(angles), np.median(angles), np.max(angles)
    kinds = Counter(node.kind for node in layout.route.nodes[1:-1])
    told = ", ".join(f"{count} {kind}" for kind, count in kinds.most_common())
    return (
        f"{len(angles)} legs of {least:.4f}° to {most:.4f}°, half of them up to {median:.4f}°; "
        f"inner nodes: {told}; --all prints every leg"
    )


def _print_distances(layout: Layout) -> None:
    """Table 1 of [MMB2017]: arcs on S³ in degrees."""
    labels = list(layout.orientations.labels)
    arcs = np.degrees(measure_arcs(layout.orientations))
    print_table(
        ["arc [deg]", *labels],
        [[label, *(f"{a:.4g}" for a in row)] for label, row in zip(labels, arcs, strict=True)],
    )
