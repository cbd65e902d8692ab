"""How evenly a set of orientations is spread: its separation and its covering radius, measured exactly."""

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between


def measure_separation(quaternions: Array) -> float:
    """Least rotation angle [rad] between two orientations of the set (N, 4), N ≥ 2."""
    from scipy.spatial import cKDTree

    both = np.concatenate([quaternions, -quaternions])
    near = np.asarray(cKDTree(both).query(quaternions, k=2)[1])
    return float(np.min(angle_between(quaternions, both[near[:, 1]])))


def measure_covering_radius(quaternions: Array) -> float:
    """Largest rotation angle [rad] of any orientation from the nearest of the set (N, 4).

    The facets of the convex hull of ±q on S³ are the cells of its Delaunay triangulation; what is
    farthest from all points is the centre of the largest, at the arc arccos of its facet's
    distance from the origin, half the rotation angle. A set within a half-space of S³, N < 4, has
    no hull around the origin: half a turn.
    """
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(np.concatenate([quaternions, -quaternions]))
    except QhullError:
        return float(np.pi)
    return float(2 * np.arccos(np.clip(np.min(-hull.equations[:, 4]), -1.0, 1.0)))
