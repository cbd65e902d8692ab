"""What is to be said of a tour: legs and turns, its certificate, the paper's distance table."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from timelaw.orientations import OrientationSet
from timelaw.tours.tour import Tour

Array = NDArray[np.float64]


def certificate(tour: Tour) -> str:
    """One sentence: the tour is shortest, and why; or how far it may be from it."""
    length, minimal = np.degrees(tour.length), np.degrees(tour.minimal)
    bound = tour.legs * minimal
    if tour.is_shortest:
        return f"no tour is shorter: {tour.legs} legs × the minimal distance {minimal:.6g}° = {length:.6g}°"
    return (
        f"length {length:.6g}°; no tour is shorter than {tour.legs} legs × the minimal distance "
        f"{minimal:.6g}° = {bound:.6g}°, so this one is at most {length / bound - 1:.2%} too long"
    )


def arc_table(points: OrientationSet) -> Array:
    """arccos(q_i·q_j) (N, N) [rad] on S³, without absolute value, as table 1 of [MMB2017] has it."""
    return np.arccos(np.clip(points.quaternions @ points.quaternions.T, -1.0, 1.0))


def orientation_csv(points: OrientationSet, tour: Tour) -> str:
    """The orientations in the order of the tour, as a table that `tour: given` visits as it stands.

    The first of a closed tour is not repeated: `closed: true` returns to it.
    """
    rows: list[list[Any]] = [["label", "w", "x", "y", "z"]]
    rows += [[points.labels[i], *(repr(float(c)) for c in points.quaternions[i])] for i in tour.order]
    return "\n".join(",".join(map(_quoted, row)) for row in rows) + "\n"


def _quoted(cell: str) -> str:
    """A cell as CSV needs it."""
    special = any(c in cell for c in ',"\n\r#') or cell != cell.strip()
    return '"' + cell.replace('"', '""') + '"' if special else cell
