"""Rotation angles between orientations, and the least of them."""

from math import acos, pi

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between
from timelaw.orientations.spread import measure_separation
from timelaw.tours.search.costs import CostMatrix, Costs, Indices, Leg

MANY = 5000  # orientations from which on nearest ones are looked up, not compared with all others
FEW = 100  # orientations; the angles between more are not kept
CHORD_ROUNDING = 1e-12  # on S³; what is looked at needlessly only costs time
BLOCK = 256  # rows of the distance matrix at a time: a few megabytes also for many orientations
CLOSE = 0.9999  # |q_i·q_j| from which its arccos loses digits: 1.6° of body turn
NEIGHBOUR_TOLERANCE = 1e-9  # rad; lattice distances agree to 1e-15, and differ by 0.1 and more otherwise


class Angles:
    """Body rotation angles [rad] between orientations (N, 4) as the costs of legs; none is kept.

    They are reckoned without BLAS, whose sums depend on how many threads it has.
    """

    def __init__(self, quaternions: Array) -> None:
        self._quaternions = quaternions
        self._parts = np.ascontiguousarray(quaternions.T)

    def __len__(self) -> int:
        return len(self._quaternions)

    def row(self, node: int) -> Array:
        """Angles (N,) from one orientation to all."""
        w, x, y, z = self._quaternions[node].tolist()
        cosines = self._parts[0] * w
        for part, factor in zip(self._parts[1:], (x, y, z), strict=True):
            cosines += part * factor
        angles, close = _open(cosines)
        if len(close) > 1:
            angles[close] = angle_between(self._quaternions[node], self._quaternions[close])
        return angles

    def legs(self, origins: Indices, targets: Indices) -> Array:
        """2 arccos|q_i·q_j|, or where that loses digits as of `angle_between`."""
        first, second = self._quaternions[origins], self._quaternions[targets]
        angles, close = _open(np.asarray(np.sum(first * second, axis=1)))
        angles[close] = angle_between(first[close], second[close])
        return angles

    @property
    def largest(self) -> float:
        """Half a turn."""
        return pi

    def price(self, prices: Array) -> Leg:
        """The angle of one leg and the prices of its ends."""
        w, x, y, z = self._parts.tolist()
        q, of = self._quaternions, prices.tolist()

        def price(i: int, j: int) -> float:
            cosine = abs(w[i] * w[j] + x[i] * x[j] + y[i] * y[j] + z[i] * z[j])
            angle = 2 * acos(cosine) if cosine < CLOSE else float(angle_between(q[i], q[j]))
            return float(angle + of[i] + of[j])

        return price

    def nearest(self, count: int) -> Indices:
        """Nearest orientations (N, count), looked up on S³ with both signs of each."""
        from scipy.spatial import cKDTree

        both = np.concatenate([self._quaternions, -self._quaternions])
        found = np.asarray(cKDTree(both).query(self._quaternions, k=count + 1)[1]) % len(self)
        own = found == np.arange(len(self))[:, None]
        own[~np.any(own, axis=1), -1] = True  # where others are the same orientation
        return np.asarray(found[~own].reshape(len(self), count))


def _open(cosines: Array) -> tuple[Array, Indices]:
    """2 arccos|c|, and where |c| is too near to one for that."""
    np.abs(cosines, out=cosines)
    np.minimum(cosines, 1.0, out=cosines)
    close = np.flatnonzero(cosines > CLOSE)
    np.arccos(cosines, out=cosines)
    cosines *= 2
    return cosines, close


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


def list_neighbours(quaternions: Array, precision: float = 0.0) -> list[list[int]]:
    """Of each orientation of (N, 4), those at the minimal distance.

    Where each may be `precision` [rad] away from what was meant, equal distances differ by four times that.
    """
    from scipy.spatial import cKDTree

    quaternions = quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)  # chords tell the norm
    most = find_minimal_distance(quaternions) + max(NEIGHBOUR_TOLERANCE, 4 * precision)
    both, chord = np.concatenate([quaternions, -quaternions]), 2 * np.sin(min(most, 2 * np.pi) / 4)
    around = cKDTree(both).query_ball_point(quaternions, chord + CHORD_ROUNDING, return_sorted=True)
    found = []
    for node, near in enumerate(around):
        others = np.unique(
            np.array(
                [other % len(quaternions) for other in near if other % len(quaternions) != node], dtype=int
            )
        )
        within = angle_between(quaternions[node], quaternions[others]) <= most
        found.append([int(other) for other in others[within]])
    return found


def measure_costs(quaternions: Array) -> Costs:
    """Angles as costs of legs: those of a few all at once."""
    return CostMatrix(measure_distances(quaternions)) if len(quaternions) <= FEW else Angles(quaternions)
