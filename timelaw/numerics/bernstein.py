"""Polynomials on [0, 1] in Bernstein form: p(u) = Σ c_i C(n, i) u^i (1 - u)^(n - i).

Control points stand on the last axis, so every function works on stacks of polynomials of one
degree. The form is kept from the solver to the law file: control points bound the polynomial,
subdivision is a convex combination, and neither ever loses digits as the power form does.
"""

from functools import cache
from math import comb, perm

import numpy as np
from numpy.typing import ArrayLike

from timelaw.numerics.array import Array

UNIT_ROUNDOFF = float(np.finfo(float).eps) / 2


def evaluate(control: ArrayLike, u: ArrayLike) -> Array:
    """p(u) by de Casteljau: control (..., n+1) and u (...) broadcast; returns (...)."""
    u = np.asarray(u, dtype=float)[..., None]
    c = np.asarray(control, dtype=float)
    c = np.broadcast_to(c, (*np.broadcast_shapes(c.shape[:-1], u.shape[:-1]), c.shape[-1]))
    while c.shape[-1] > 1:
        c = (1 - u) * c[..., :-1] + u * c[..., 1:]
    return np.array(c[..., 0])


def differentiate(control: ArrayLike, order: int = 1) -> Array:
    """Control points of the derivative, n!/(n - k)! Δ^k c; of degree 0 where order k > n."""
    c = np.asarray(control, dtype=float)
    degree = c.shape[-1] - 1
    if order > degree:
        return np.zeros_like(c[..., :1])
    return np.asarray(
        np.diff(c, n=order, axis=-1) * float(perm(degree, order))
    )  # differences are often exact


@cache
def halving_matrix(degree: int) -> Array:
    """Matrix (2(n+1), n+1): control points of both halves of a polynomial of this degree."""
    left = np.array([[comb(i, j) / 2.0**i for j in range(degree + 1)] for i in range(degree + 1)])
    both = np.concatenate([left, left[::-1, ::-1]])
    both.setflags(write=False)
    return both


def split(control: ArrayLike, u: float) -> tuple[Array, Array]:
    """Control points of p on [0, u] and on [u, 1], both over [0, 1], by de Casteljau."""
    c = np.asarray(control, dtype=float)
    left, right = [c[..., 0]], [c[..., -1]]
    while c.shape[-1] > 1:
        c = (1 - u) * c[..., :-1] + u * c[..., 1:]
        left.append(c[..., 0])
        right.append(c[..., -1])
    return np.stack(left, axis=-1), np.stack(right[::-1], axis=-1)


def elevate(control: ArrayLike, degree: int) -> Array:
    """The same polynomial written with the given, not lower, degree."""
    c = np.asarray(control, dtype=float)
    while (n := c.shape[-1] - 1) < degree:
        share = np.arange(1, n + 1) / (n + 1)
        inner = share * c[..., :-1] + (1 - share) * c[..., 1:]
        c = np.concatenate([c[..., :1], inner, c[..., -1:]], axis=-1)
    return c


def basis_matrix(degree: int, u: ArrayLike, order: int = 0) -> Array:
    """Matrix E (m, n+1) with p^(k)(u_i) = Σ_j E_ij c_j for the m points u and k = `order`."""
    columns = differentiate(np.eye(degree + 1), order)  # row j: control points of the j-th basis function
    return evaluate(columns[None, :, :], np.asarray(u, dtype=float)[:, None])


def hermite_matrix(degree: int, count: int) -> Array:
    """Matrix H (count, count): the first control points from p(0), p'(0), …: c = H g.

    c_j = Σ_{i ≤ j} C(j, i) (n - i)!/n! p^(i)(0).
    """
    falling = [1.0]
    for i in range(1, count):
        falling.append(falling[-1] / (degree - i + 1))
    return np.array([[comb(j, i) * falling[i] for i in range(count)] for j in range(count)])


def smooth_ends(order: int) -> Array:
    """Control points in rows (r+1, 2r+2): the i-th derivative at 0 is 1, all others up to the r-th are zero.

    At 1 all are zero; mirrored, with the signs of odd derivatives changed, they are those of the other end.
    """
    block = hermite_matrix(2 * order + 1, order + 1)
    return np.concatenate([block, np.zeros_like(block)]).T


def integrate_square(control: ArrayLike) -> Array:
    """∫₀¹ p(u)² du (...) by Gauss-Legendre with n + 1 nodes, exact for degree 2n up to rounding."""
    c = np.asarray(control, dtype=float)
    weights, values = _quadrature(c.shape[-1] - 1)
    return np.asarray((c @ values.T) ** 2 @ weights)


@cache
def _quadrature(degree: int) -> tuple[Array, Array]:
    """Gauss-Legendre weights (n+1,) on [0, 1], and the basis at the nodes (n+1, n+1)."""
    nodes, weights = np.polynomial.legendre.leggauss(degree + 1)
    return weights / 2, basis_matrix(degree, (nodes + 1) / 2)
