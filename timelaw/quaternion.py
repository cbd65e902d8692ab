"""Quaternion algebra [IR2016]: arrays (..., 4), scalar first (w, x, y, z), i² = j² = k² = -1, ij = k.

A unit quaternion turns the body: v ↦ q v q⁻¹; turns in succession are products, the later one on the left.
q and -q are the same orientation. Everything broadcasts.
"""

import numpy as np
from numpy.typing import ArrayLike

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import conjugate, multiply, normalise, rotation_matrix
from timelaw.numerics.turn import HALF_TURN

__all__ = [
    "conjugate",
    "exp",
    "exp_of_unit",
    "from_complex_pair",
    "from_matrix",
    "inverse",
    "left_matrix",
    "log",
    "norm",
    "normalise",
    "power",
    "product",
    "right_matrix",
    "rotate",
    "slerp",
    "to_complex_pair",
    "to_matrix",
]
Complex = np.ndarray[tuple[int, ...], np.dtype[np.complex128]]
NOT_ORTHOGONAL = 1e-6  # of an entry of RᵀR; doubles err by 1e-15, single precision by 1e-7

product = multiply


def norm(q: ArrayLike) -> Array:
    """|q| (...), the root of q q*; |p q| = |p||q|."""
    return np.asarray(np.linalg.norm(_read(q), axis=-1))


def inverse(q: ArrayLike) -> Array:
    """q⁻¹ = q*/|q|² (..., 4).

    Raises:
        ValueError: q is zero.
    """
    q = _read_nonzero(q)
    return np.asarray(conjugate(q) / np.sum(q * q, axis=-1, keepdims=True))


def left_matrix(q: ArrayLike) -> Array:
    """L(q) (..., 4, 4), real: q p = L(q) p for every p (4,), and L(p q) = L(p) L(q)."""
    q = _read(q)
    columns = [multiply(q, unit) for unit in np.eye(4)]
    return np.stack(columns, axis=-1)


def right_matrix(q: ArrayLike) -> Array:
    """R(q) (..., 4, 4), real: p q = R(q) p for every p (4,), and R(p q) = R(q) R(p)."""
    q = _read(q)
    columns = [multiply(unit, q) for unit in np.eye(4)]
    return np.stack(columns, axis=-1)


def to_complex_pair(q: ArrayLike) -> tuple[Complex, Complex]:
    """(a, b) (...) with q = a + b j: a = w + x i, b = y + z i; (a, b)(c, d) = (a c - b d̄, a d + b c̄)."""
    w, x, y, z = np.moveaxis(_read(q), -1, 0)
    return np.asarray(w + 1j * x), np.asarray(y + 1j * z)


def from_complex_pair(a: ArrayLike, b: ArrayLike) -> Array:
    """The quaternion a + b j (..., 4) of complex numbers a, b (...)."""
    a, b = np.broadcast_arrays(np.asarray(a, dtype=complex), np.asarray(b, dtype=complex))
    return np.stack([a.real, a.imag, b.real, b.imag], axis=-1)


def exp_of_unit(u: ArrayLike, angle: ArrayLike) -> Array:
    """Euler's formula e^{Uφ} = cos φ + U sin φ (..., 4) for a unit imaginary U (..., 3).

    e^{Uφ/2} v e^{-Uφ/2} turns v by φ about U.

    Raises:
        ValueError: |U| is not 1.
    """
    u, angle = np.asarray(u, dtype=float), np.asarray(angle, dtype=float)[..., None]
    if u.shape[-1:] != (3,) or not np.allclose(np.linalg.norm(u, axis=-1), 1, rtol=0, atol=NOT_ORTHOGONAL):
        raise ValueError("a unit imaginary (..., 3) is needed")
    return np.concatenate([np.cos(angle) + 0 * u[..., :1], np.sin(angle) * u], axis=-1)


def exp(q: ArrayLike) -> Array:
    """e^q = e^w (cos |v| + v/|v| sin |v|) (..., 4), v the imaginary part."""
    q = _read(q)
    v = q[..., 1:]
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    turned = np.concatenate([np.cos(size), np.sinc(size / np.pi) * v], axis=-1)
    return np.asarray(np.exp(q[..., :1]) * turned)


def log(q: ArrayLike) -> Array:
    """The principal logarithm ln|q| + v/|v| φ (..., 4), φ = atan2(|v|, w) in [0, π]; that of -1 is π i.

    Raises:
        ValueError: q is zero.
    """
    q = _read_nonzero(q)
    v = q[..., 1:]
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    axis = np.where(size > 0, v / np.where(size > 0, size, 1.0), [1.0, 0.0, 0.0])
    angle = np.arctan2(size, q[..., :1])
    return np.concatenate([np.log(norm(q))[..., None], axis * angle], axis=-1)


def power(q: ArrayLike, exponent: ArrayLike) -> Array:
    """q^t = e^{t ln q} (..., 4), t (...) real.

    Raises:
        ValueError: q is zero.
    """
    return exp(np.asarray(exponent, dtype=float)[..., None] * log(q))


def slerp(p: ArrayLike, q: ArrayLike, u: ArrayLike) -> Array:
    """The shorter way round, p (p⁻¹ q)^u (..., 4): unit quaternions at u (...) from p (0) to ±q (1).

    For a half-turn both ways are as short; that about the axis of p⁻¹ q as it stands is taken.

    Raises:
        ValueError: p or q is zero.
    """
    p, q = normalise(_read_nonzero(p)), normalise(_read_nonzero(q))
    between = multiply(conjugate(p), q)
    near = np.where(between[..., :1] < -HALF_TURN, -between, between)
    return multiply(p, power(near, u))


def rotate(q: ArrayLike, v: ArrayLike) -> Array:
    """The product q v q⁻¹ (..., 3): the vector v (..., 3) turned by q, of any length but zero.

    Raises:
        ValueError: q is zero, or v has not three components.
    """
    v = np.asarray(v, dtype=float)
    if v.shape[-1:] != (3,):
        raise ValueError(f"vectors (..., 3) are needed, not {v.shape}")
    return np.asarray(np.einsum("...ij,...j->...i", to_matrix(q), v))


def to_matrix(q: ArrayLike) -> Array:
    """χ(q) (..., 3, 3), the rotation of any quaternion but zero: divided by |q|² [HZ2019].

    The printed χ has q0 q2 in entry (3, 2), where q0 q1 belongs.

    Raises:
        ValueError: q is zero.
    """
    return rotation_matrix(normalise(_read_nonzero(q)))


def from_matrix(matrix: ArrayLike) -> Array:
    """χ⁻¹ (..., 4): one of the two unit quaternions of a rotation matrix, that with w ≥ 0; the other is -q.

    The rows of 4 q qᵀ are four ratios w : x : y : z; the one with the largest entry on the diagonal is taken,
    which is never 0 : 0 : 0 : 0 [HZ2019].

    Raises:
        ValueError: RᵀR is not 1, or the determinant is -1.
    """
    r = np.asarray(matrix, dtype=float)
    if r.shape[-2:] != (3, 3):
        raise ValueError(f"matrices (..., 3, 3) are needed, not {r.shape}")
    error = np.abs(np.swapaxes(r, -1, -2) @ r - np.eye(3))
    if not np.all(error <= NOT_ORTHOGONAL) or not np.all(np.linalg.det(r) > 0):
        raise ValueError("not a rotation matrix: RᵀR is not 1, or its determinant is -1")
    (a, b, c), (d, e, f), (g, h, i) = (np.moveaxis(r[..., k, :], -1, 0) for k in range(3))
    ratios = np.stack(
        [
            np.stack([1 + a + e + i, h - f, c - g, d - b], axis=-1),
            np.stack([h - f, 1 + a - e - i, b + d, c + g], axis=-1),
            np.stack([c - g, b + d, 1 - a + e - i, f + h], axis=-1),
            np.stack([d - b, c + g, f + h, 1 - a - e + i], axis=-1),
        ],
        axis=-2,
    )
    best = np.argmax(np.diagonal(ratios, axis1=-2, axis2=-1), axis=-1)
    row = np.take_along_axis(ratios, best[..., None, None], axis=-2)[..., 0, :]
    q = normalise(row)
    return np.asarray(np.where(q[..., :1] < 0, -q, q))


def _read(q: ArrayLike) -> Array:
    q = np.asarray(q, dtype=float)
    if q.shape[-1:] != (4,):
        raise ValueError(f"quaternions (..., 4) are needed, not {q.shape}")
    return q


def _read_nonzero(q: ArrayLike) -> Array:
    q = _read(q)
    if not np.all(np.any(q != 0, axis=-1)):
        raise ValueError("a quaternion other than zero is needed")
    return q
