"""Quaternions (w, x, y, z) once more, written apart from the program's."""

import numpy as np


def product(p, q):
    """Hamilton's product of (..., 4) and (..., 4)."""
    p, q = np.asarray(p, dtype=float), np.asarray(q, dtype=float)
    scalar = p[..., :1] * q[..., :1] - np.sum(p[..., 1:] * q[..., 1:], axis=-1, keepdims=True)
    vector = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + np.cross(p[..., 1:], q[..., 1:])
    return np.concatenate([scalar, vector], axis=-1)


def inverse(q):
    """Of unit quaternions."""
    return np.asarray(q, dtype=float) * np.array([1.0, -1.0, -1.0, -1.0])


def unit(q):
    """Of norm one."""
    q = np.asarray(q, dtype=float)
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def about(axis, angle):
    """The turn by `angle` about the unit `axis`."""
    half = np.asarray(angle, dtype=float)[..., None] / 2
    return np.concatenate([np.cos(half), np.sin(half) * np.asarray(axis, dtype=float)], axis=-1)


def turn(p, q):
    """Axis (3,) and angle in [0, π] of the shorter turn from p to q."""
    d = product(inverse(p), q)
    d = -d if d[0] < 0 else d
    size = float(np.linalg.norm(d[1:]))
    axis = d[1:] / size if size > 0 else np.array([1.0, 0.0, 0.0])
    return axis, 2 * float(np.arctan2(size, d[0]))


def apart(p, q):
    """Angle [rad] between orientations (..., 4)."""
    d = product(inverse(p), q)
    return 2 * np.arctan2(np.linalg.norm(d[..., 1:], axis=-1), np.abs(d[..., 0]))


def to_body(q, vector):
    """World vectors (3,) in the axes of bodies at q (..., 4)."""
    pure = np.concatenate([[0.0], vector])
    return product(product(inverse(q), np.broadcast_to(pure, np.shape(q))), q)[..., 1:]


def axes_apart(first, second):
    """Angle between two unit axes, in [0, π]."""
    return float(np.arctan2(np.linalg.norm(np.cross(first, second)), np.dot(first, second)))
