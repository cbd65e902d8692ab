"""The orientations of a tour as a table, in the order of its visits."""

from typing import Any

from timelaw.numerics.array import Array
from timelaw.orientations import OrientationSet
from timelaw.route import Route
from timelaw.tours import Tour


def format_orientations(points: OrientationSet, tour: Tour, route: Route) -> str:
    """The orientations in the order of the tour, as a table that `tour: given` visits as it stands.

    The first of a closed tour is not repeated: `closed: true` returns to it. Nodes that the route has moved
    stand where it has them.
    """
    placed = _place(points, tour, route)
    rows: list[list[Any]] = [["label", "w", "x", "y", "z"]]
    rows += [[points.labels[i], *(repr(float(c)) for c in placed[i])] for i in tour.order]
    return "\n".join(",".join(map(_quoted, row)) for row in rows) + "\n"


def _place(points: OrientationSet, tour: Tour, route: Route) -> Array:
    """Quaternions (N, 4) with the signs they were given with, the moved ones where they were moved to."""
    placed = points.quaternions.copy()
    for i, node, leg in zip(tour.order, route.nodes, (*route.legs, None), strict=False):
        if node.moved > 0:
            there = route.legs[-1].end if leg is None else leg.start
            placed[i] = there if float(there @ placed[i]) > 0 else -there
    return placed


def _quoted(cell: str) -> str:
    """A cell as CSV needs it."""
    special = any(c in cell for c in ',"\n\r#') or cell != cell.strip()
    return '"' + cell.replace('"', '""') + '"' if special else cell
