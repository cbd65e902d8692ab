"""Great circles on S³: the orientations that a body passes while it turns about one axis."""

from dataclasses import dataclass

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import conjugate, multiply

ROUNDS = 60  # of Lawson's weights; distances then are within a few percent of the least there are


@dataclass(frozen=True)
class GreatCircle:
    """q(t) = u cos t + v sin t, with orthonormal u, v (4,): the body turns by 2t about one axis from u on."""

    u: Array
    v: Array

    @property
    def axis(self) -> Array:
        """The unit axis n (3,) in body axes: u* ⊗ v = (0, n)."""
        axis = multiply(conjugate(self.u), self.v)[1:]
        return np.asarray(axis / np.linalg.norm(axis))

    @property
    def normals(self) -> Array:
        """Orthonormal columns (4, 2) that span what is at right angles to the circle."""
        return np.linalg.qr(np.column_stack([self.u, self.v]), mode="complete")[0][:, 2:]

    def reversed(self) -> "GreatCircle":
        """The same circle in the other sense."""
        return GreatCircle(self.u, -self.v)

    def begun_at(self, t: float) -> "GreatCircle":
        """The same circle with t = 0 elsewhere."""
        c, s = np.cos(t), np.sin(t)
        return GreatCircle(c * self.u + s * self.v, c * self.v - s * self.u)

    def places(self, points: Array) -> Array:
        """Where on the circle, t (n,) [rad], each of the orientations (n, 4) is nearest to it."""
        return np.arctan2(points @ self.v, points @ self.u)

    def offsets(self, points: Array) -> Array:
        """Sines (n,) of the distances on S³ of the orientations (n, 4) from the circle."""
        return np.asarray(np.linalg.norm(points @ self.normals, axis=1))

    def nearest(self, points: Array) -> Array:
        """The unit quaternions (n, 4) on the circle nearest to each of the orientations (n, 4)."""
        t = self.places(points)[:, None]
        return np.cos(t) * self.u + np.sin(t) * self.v


def fit_circle(points: Array, within: float) -> GreatCircle | None:
    """A great circle that no one of the orientations (n, 4) is farther from than `within` [rad of body turn].

    First the one of least squares, then with the weights of those raised that are far away (Lawson), which
    leads to the one whose largest distance is least. None where there is no such circle: the weighted root
    mean square is never above that largest distance.
    """
    most = np.sin(within / 2)
    weights = np.full(len(points), 1 / len(points))
    for _ in range(ROUNDS):
        weighted = np.sqrt(weights)[:, None] * points
        rows = np.linalg.svd(weighted, full_matrices=False)[2][:2]
        # of nearly equal singular values the plane is tens of roundings off; after a power step it is not
        plane, scale = np.linalg.qr(weighted.T @ (weighted @ rows.T))
        plane = plane * np.sign(np.diag(scale))
        circle = GreatCircle(plane[:, 0], plane[:, 1])
        far = circle.offsets(points)
        if np.max(far) <= most:
            return circle
        if np.sum(weights * far**2) > most**2:
            return None
        weights = weights * far
        weights /= np.sum(weights)
    return None
