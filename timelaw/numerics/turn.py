"""The turn from one orientation to another: about which axis, by how much, and where that is not unique."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import conjugate, multiply

HALF_TURN = 1e-9  # |q_i·q_j| below which both axes of a half-turn are equally short
SAME_ORIENTATION = 1e-6  # rad; below it two orientations are one, and the axis between them is noise
SAME_AXIS = 1e-7  # rad; below it two axes are one: quaternions typed with 7 digits still go straight
LARGEST_NONE = 0.5  # rad; more than this is a corner, however short the legs


class Turn(NamedTuple):
    """Unit axis n (..., 3) in body axes, angle θ (...) ∈ [0, π] [rad], and whether -n would do as well."""

    axis: Array
    angle: Array
    half: NDArray[np.bool_]


def find_turn(p: ArrayLike, q: ArrayLike, precision: float = 0.0) -> Turn:
    """The shorter turn from p to q, unit quaternions (..., 4) that broadcast.

    θ = 2 atan2(|v|, |w|) of p* ⊗ q = (w, v), which is exact also where arccos is not; n = ±v/|v|, and x
    where nothing turns. For a half-turn -n and 2π - θ do as well; so it is where each of the two need be
    turned by `precision` [rad] at most to make it one.
    """
    d = multiply(conjugate(p), q)
    vector = d[..., 1:]
    # the norm of a single vector is BLAS's, which rounds it once less
    size = np.asarray(np.linalg.norm(vector, axis=-1 if vector.ndim > 1 else None))[..., None]
    axis = np.where(size > 0, vector / np.where(size > 0, size, 1.0), [1.0, 0.0, 0.0])
    angle = 2 * np.arctan2(size[..., 0], np.abs(d[..., 0]))
    half = np.abs(d[..., 0]) <= max(HALF_TURN, precision)
    return Turn(axis * np.where(d[..., :1] >= 0, 1.0, -1.0), angle, half)


def choose_sense(axis: Array, precision: float = 0.0) -> Array:
    """Of n and -n (3,) the one whose first component that is not zero, within `precision`, is positive."""
    return axis if axis[np.argmax(np.abs(axis) > max(SAME_AXIS, precision))] > 0 else -axis


def allow_turn(before: ArrayLike, after: ArrayLike, precision: float) -> Array:
    """Largest turn ψ [rad] of the axis between two legs, of angles (...) [rad], that may be taken for none.

    The three nodes are then within `precision` δ [rad of body turn] of one great circle: with A, B the
    legs' halves, the distances from the nearest one are all 2 sin(ψ/2) sin A sin B / (sin A + sin B +
    |sin(A + B)|) on S³. Never less than SAME_AXIS, nor so much that a leg may turn aside.
    """
    a, b = np.asarray(before, dtype=float) / 2, np.asarray(after, dtype=float) / 2
    shares = np.sin(a) + np.sin(b) + np.abs(np.sin(a + b))
    with np.errstate(divide="ignore", invalid="ignore"):
        chord = np.sin(precision / 2) * shares / (np.sin(a) * np.sin(b))
    allowed = np.minimum(np.nan_to_num(chord, nan=0.0, posinf=LARGEST_NONE), LARGEST_NONE)
    return np.asarray(np.maximum(SAME_AXIS, allowed))


def angle_between_axes(first: Array, second: Array) -> float:
    """Angle [rad, 0 to π] between two unit axes (3,)."""
    return float(np.arctan2(np.linalg.norm(np.cross(first, second)), float(first @ second)))
