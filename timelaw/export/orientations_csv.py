"""The orientations of a tour as a table, in the order of its visits."""

from typing import Any

from timelaw.numerics.array import Array
from timelaw.orientations import OrientationSet
from timelaw.route import Route
from timelaw.tours import Tour


def format_orientations(points: OrientationSet, tour: Tour, route: Route) -> str:
    """The orientations in the order of the tour, as a table that `tour: given` visits as it stands.

    The first of a closed tour is not repeated: `closed: true` returns to it. A second visit to "a" has
    the label "a (2)". Nodes that the route has moved stand where it has them.
    """
    placed = _place(points, tour, route)
    rows: list[list[Any]] = [["label", "w", "x", "y", "z"]]
    taken = set(points.labels)
    visited: set[int] = set()
    for i, quaternion in zip(tour.order, placed, strict=True):
        label, visit = points.labels[i], 1
        while i in visited and label in taken:
            visit += 1
            label = f"{points.labels[i]} ({visit})"
        visited.add(i)
        taken.add(label)
        rows.append([label, *(repr(float(c)) for c in quaternion)])
    return "\n".join(",".join(map(_quoted, row)) for row in rows) + "\n"


def _place(points: OrientationSet, tour: Tour, route: Route) -> list[Array]:
    """Quaternions (4,) visit by visit, with the signs they had, moved ones where they were moved to."""
    placed = []
    for i, node, leg in zip(tour.order, route.nodes, (*route.legs, None), strict=False):
        given = points.quaternions[i]
        there = route.legs[-1].end if leg is None else leg.start
        placed.append(given if not node.moved else there if float(there @ given) > 0 else -there)
    return placed


def _quoted(cell: str) -> str:
    """A cell as CSV needs it."""
    special = any(c in cell for c in ',"\n\r#') or cell != cell.strip()
    return '"' + cell.replace('"', '""') + '"' if special else cell
