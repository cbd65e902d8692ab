"""Quaternion algebra on arrays of shape (..., 4), scalar first, Hamilton [IR2016].

A unit quaternion q = (cos(θ/2), n sin(θ/2)) turns the body by θ about the unit axis n:
r_world = q r_body q*. q and -q are the same orientation.
"""

import numpy as np
from numpy.typing import ArrayLike

from timelaw.numerics.array import Array

LEAST_NORM = 1e-150  # squares of what is smaller vanish


def multiply(p: ArrayLike, q: ArrayLike) -> Array:
    """Hamilton product p ⊗ q, shapes (..., 4) → (..., 4); q acts first, p later."""
    pw, px, py, pz = np.moveaxis(np.asarray(p, dtype=float), -1, 0)
    qw, qx, qy, qz = np.moveaxis(np.asarray(q, dtype=float), -1, 0)
    return np.stack(
        [
            pw * qw - px * qx - py * qy - pz * qz,
            pw * qx + px * qw + py * qz - pz * qy,
            pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw,
        ],
        axis=-1,
    )


def conjugate(q: ArrayLike) -> Array:
    """q* = (w, -x, -y, -z), shape (..., 4); the inverse of a unit quaternion."""
    return np.array(np.asarray(q, dtype=float) * [1.0, -1.0, -1.0, -1.0])


def from_axis_angle(axis: ArrayLike, angle: ArrayLike) -> Array:
    """(cos(θ/2), n sin(θ/2)): the turn by `angle` (...) [rad] about the unit `axis` (..., 3)."""
    half = np.asarray(angle, dtype=float)[..., None] / 2
    return np.concatenate([np.cos(half), np.sin(half) * np.asarray(axis, dtype=float)], axis=-1)


def rotation_matrix(q: ArrayLike) -> Array:
    """R(q), shape (..., 3, 3), of unit quaternions (..., 4): r_world = R r_body [HZ2019].

    The printed matrix of [HZ2019] has q0 q2 in entry (3, 2), where q0 q1 belongs.
    """
    w, x, y, z = np.moveaxis(np.asarray(q, dtype=float), -1, 0)
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def normalise(v: ArrayLike) -> Array:
    """Vectors (..., k) over their norms, however small or large; not numbers where there is no direction."""
    v = np.asarray(v, dtype=float)
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    if np.all((size > LEAST_NORM) & (size < 1 / LEAST_NORM)):
        return np.array(v / size)
    largest = np.max(np.abs(v), axis=-1, keepdims=True)
    v = v / np.where(largest > 0, largest, np.nan)
    return np.array(v / np.linalg.norm(v, axis=-1, keepdims=True))


def rotation_between(p: ArrayLike, q: ArrayLike) -> float:
    """Rotation angle [rad, 0 to 2π] from p to q (4,) of any norm, signs included: 2π between q and -q.

    4 arcsin(|p - q|/2) of the unit quaternions, which is exact where they are close.
    """
    half = float(np.linalg.norm(normalise(p) - normalise(q))) / 2
    return float(4 * np.arcsin(np.minimum(half, 1.0)))


def angle_between(p: ArrayLike, q: ArrayLike) -> Array:
    """Rotation angle [rad, 0 to π] between orientations (..., 4), also exact near 0 and π."""
    d = multiply(conjugate(p), q)
    return np.array(2 * np.arctan2(np.linalg.norm(d[..., 1:], axis=-1), np.abs(d[..., 0])))
