"""Rotation angles between orientations, and the least of them."""

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between
from timelaw.orientations.spread import measure_separation

MANY = 5000  # orientations from which on nearest ones are looked up, not compared with all others
BLOCK = 256  # rows of the distance matrix at a time: a few megabytes also for many orientations
NEIGHBOUR_TOLERANCE = 1e-9  # rad; lattice distances agree to 1e-15, and differ by 0.1 and more otherwise


def measure_distances(quaternions: Array) -> Array:
    """Body rotation angles (N, N) [rad] on SO(3), 2 arccos|q_i·q_j|; zeros on the diagonal."""
    return angle_between(quaternions[:, None, :], quaternions[None, :, :])


def find_minimal_distance(quaternions: Array) -> float:
    """Least rotation angle [rad] between two of the orientations (N, 4), each with its own place in the set.

    All are compared block by block; of many only the nearest ones.
    """
    if len(quaternions) > MANY:
        alone = np.unique(quaternions, axis=0)
        return measure_separation(alone) if len(alone) == len(quaternions) else 0.0
    least = np.inf
    for start in range(0, len(quaternions), BLOCK):
        rows = np.arange(start, min(start + BLOCK, len(quaternions)))
        cosines = np.abs(quaternions[rows] @ quaternions.T)
        cosines[np.arange(len(rows)), rows] = -1.0
        row, column = np.unravel_index(np.argmax(cosines), cosines.shape)
        least = min(least, float(angle_between(quaternions[rows[row]], quaternions[column])))
    return least


def list_neighbours(angles: Array, precision: float = 0.0) -> list[list[int]]:
    """Of each node, the nodes at the minimal distance, given the angles (N, N) [rad].

    Where each node may be `precision` [rad] away from what was meant, equal ones differ by four times that.
    """
    apart = angles + np.diag(np.full(len(angles), np.inf))
    near = apart <= np.min(apart) + max(NEIGHBOUR_TOLERANCE, 4 * precision)
    return [list(map(int, np.flatnonzero(row))) for row in near]
