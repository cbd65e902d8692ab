"""Rotation angles between orientations, and the least of them."""

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.quaternion import angle_between

Array = NDArray[np.float64]

NEIGHBOUR_TOLERANCE = 1e-9  # rad; lattice distances agree to 1e-15, and differ by 0.1 and more otherwise


def distances(quaternions: Array) -> Array:
    """Body rotation angles (N, N) [rad] on SO(3), 2 arccos|q_i·q_j|; zeros on the diagonal."""
    return angle_between(quaternions[:, None, :], quaternions[None, :, :])


def minimal_distance(angles: Array) -> float:
    """Least angle [rad] between two different entries of a distance matrix (N, N)."""
    return float(np.min(angles[~np.eye(len(angles), dtype=bool)]))
