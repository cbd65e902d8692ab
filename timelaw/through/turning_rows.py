"""The rates of pieces in the time of each, X = (hω, h²α, h³ jerk), and how they change with control points.

With D = Q·Q, r = D'/D, s = D''/D and v(a, b) = Vec(ā b), in units of a piece's own duration:
ω = 2 v(Q, Q')/D, α = 2 v(Q, Q'')/D - rω, jerk = 2 (v(Q, Q''') + v(Q', Q''))/D - 2rα - sω.
"""

from dataclasses import dataclass

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import basis_matrix
from timelaw.numerics.quaternion import conjugate, multiply

ORDERS = 4  # Q and three derivatives


def make_basis(degree: int, u: Array) -> Array:
    """(m, 4, d+1): at each u the Bernstein polynomials and their first three derivatives."""
    return np.stack([basis_matrix(degree, u, k) for k in range(ORDERS)], axis=1)


@dataclass(frozen=True)
class Rates:
    """X (p, m, 3, 3), by order then component, and ∂X/∂(Q, Q', Q'', Q''') (p, m, 3, 3, 4, 4)."""

    value: Array
    slope: Array


def measure_rates(points: Array, basis: Array) -> Array:
    """X (p, m, 3, 3) of control points (p, d+1, 4) at the places of a basis (m, 4, d+1) or (p, m, 4, d+1)."""
    q, v, a, u = np.moveaxis(_derivatives(points, basis), 2, 0)
    square, r, s = _norms(q, v, a)
    omega = 2 * _vector(q, v) / square
    alpha = 2 * _vector(q, a) / square - r * omega
    jerk = 2 * (_vector(q, u) + _vector(v, a)) / square - 2 * r * alpha - s * omega
    return np.stack([omega, alpha, jerk], axis=2)


def derive_rates(points: Array, basis: Array) -> Rates:
    """The rates and their slopes."""
    q, v, a, u = np.moveaxis(_derivatives(points, basis), 2, 0)
    value = measure_rates(points, basis)
    omega, alpha, jerk = (value[:, :, k] for k in range(3))
    square, r, s = _norms(q, v, a)
    shape = (*q.shape[:2], 3, ORDERS, 4)

    def blocks(**parts: Array) -> Array:
        found = np.zeros(shape)
        for name, part in parts.items():
            found[:, :, :, "qvau".index(name)] = part
        return found

    def outer(vector: Array, slope: Array) -> Array:
        """A vector (p, m, 3) times the slope (p, m, 4, 4) of a scalar."""
        return np.asarray(np.einsum("pmx,pmkc->pmxkc", vector, slope))

    d_square = _scalar(q=2 * q)
    d_r = (_scalar(q=2 * v, v=2 * q) - r[..., None] * d_square) / square[..., None]
    d_s = (_scalar(q=2 * a, v=4 * v, a=2 * q) - s[..., None] * d_square) / square[..., None]
    over = square[..., None, None]
    d_omega = (blocks(q=2 * _by_first(v), v=2 * _by_second(q)) - outer(omega, d_square)) / over
    part = blocks(q=2 * _by_first(a), a=2 * _by_second(q)) - outer(alpha + r * omega, d_square)
    rr, ss = r[..., None, None], s[..., None, None]
    d_alpha = part / over - outer(omega, d_r) - rr * d_omega
    part = blocks(q=2 * _by_first(u), u=2 * _by_second(q), v=2 * _by_first(a), a=2 * _by_second(v))
    part = (part - outer(jerk + 2 * r * alpha + s * omega, d_square)) / over
    d_jerk = part - 2 * outer(alpha, d_r) - 2 * rr * d_alpha - outer(omega, d_s) - ss * d_omega
    return Rates(value, np.stack([d_omega, d_alpha, d_jerk], axis=2))


def _derivatives(points: Array, basis: Array) -> Array:
    """(p, m, 4, 4): Q and its derivatives at each place."""
    form = "mko,poc->pmkc" if basis.ndim == 3 else "pmko,poc->pmkc"
    return np.asarray(np.einsum(form, basis, points))


def _norms(q: Array, v: Array, a: Array) -> tuple[Array, Array, Array]:
    square = np.sum(q * q, axis=-1, keepdims=True)
    first = 2 * np.sum(q * v, axis=-1, keepdims=True) / square
    second = 2 * np.sum(v * v + q * a, axis=-1, keepdims=True) / square
    return square, first, second


def _scalar(**parts: Array) -> Array:
    """The slope (p, m, 4, 4) of a scalar."""
    shape = next(iter(parts.values())).shape
    found = np.zeros((*shape[:2], ORDERS, 4))
    for name, part in parts.items():
        found[:, :, "qvau".index(name)] = part
    return found


def _vector(a: Array, b: Array) -> Array:
    """Vec(ā b)."""
    return np.asarray(multiply(conjugate(a), b)[..., 1:])


def _by_first(b: Array) -> Array:
    """∂v(a, b)/∂a (p, m, 3, 4): [b⃗ | -b₀ I + b⃗ ×]."""
    return np.concatenate([b[..., 1:, None], _across(b[..., 1:]) - b[..., :1, None] * np.eye(3)], axis=-1)


def _by_second(a: Array) -> Array:
    """∂v(a, b)/∂b (p, m, 3, 4): [-a⃗ | a₀ I - a⃗ ×]."""
    return np.concatenate([-a[..., 1:, None], a[..., :1, None] * np.eye(3) - _across(a[..., 1:])], axis=-1)


def _across(w: Array) -> Array:
    """The matrices (…, 3, 3) of w × ·."""
    x, y, z = np.moveaxis(w, -1, 0)
    zero = np.zeros_like(x)
    rows = [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
