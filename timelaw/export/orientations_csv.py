"""The orientations of a tour as a table, in the order of its visits."""

from typing import Any

from timelaw.orientations import OrientationSet
from timelaw.tours import Tour


def format_orientations(points: OrientationSet, tour: Tour) -> str:
    """The orientations in the order of the tour, as a table that `tour: given` visits as it stands.

    The first of a closed tour is not repeated: `closed: true` returns to it. A second visit to "a" has
    the label "a (2)".
    """
    rows: list[list[Any]] = [["label", "w", "x", "y", "z"]]
    taken = set(points.labels)
    visited: set[int] = set()
    for i in tour.order:
        label, visit = points.labels[i], 1
        while i in visited and label in taken:
            visit += 1
            label = f"{points.labels[i]} ({visit})"
        visited.add(i)
        taken.add(label)
        rows.append([label, *(repr(float(c)) for c in points.quaternions[i])])
    return "\n".join(",".join(map(_quoted, row)) for row in rows) + "\n"


def _quoted(cell: str) -> str:
    """A cell as CSV needs it."""
    special = any(c in cell for c in ',"\n\r#') or cell != cell.strip()
    return '"' + cell.replace('"', '""') + '"' if special else cell
