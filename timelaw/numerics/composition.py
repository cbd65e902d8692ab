"""Polynomials of polynomials in Bernstein form, in extended precision: they are rounded once, at the end.

High derivatives at the ends of short pieces are differences of control points, in which each rounding on the
way would count.
"""

from itertools import pairwise
from math import comb

import numpy as np
from numpy.typing import ArrayLike, NDArray

from timelaw.numerics.array import Array

Wide = NDArray[np.longdouble]  # no wider than a double on some machines, where a few digits less are left


def multiply_control(a: ArrayLike, b: ArrayLike) -> Wide:
    """Control points (m+n+1, ...) of a product, a (m+1,) a scalar, b (n+1, ...) a scalar or a vector."""
    left, right = np.asarray(a, dtype=np.longdouble), np.asarray(b, dtype=np.longdouble)
    m, n = len(left) - 1, len(right) - 1
    rows = right.reshape(n + 1, -1) * _binomials(n)[:, None]
    product = np.stack([np.convolve(left * _binomials(m), column) for column in rows.T], axis=1)
    return np.asarray((product / _binomials(m + n)[:, None]).reshape(m + n + 1, *right.shape[1:]))


def compose_control(outer: ArrayLike, inner: ArrayLike) -> Wide:
    """Control points (nm+1, ...) of p(f), p by `outer` (n+1, ...), f by `inner` (m+1,), both over [0, 1].

    De Casteljau's scheme with the polynomial f in place of a number: means of means, which lose no digits
    while f stays between 0 and 1.
    """
    f = np.asarray(inner, dtype=np.longdouble)
    level = [point[None] for point in np.asarray(outer, dtype=np.longdouble)]
    while len(level) > 1:
        level = [multiply_control(1 - f, a) + multiply_control(f, b) for a, b in pairwise(level)]
    return np.asarray(level[0])


def integrate_state(duration: float, state: Array, control: Array) -> Wide:
    """Control points of a function over `duration`, from its state at the start and its next derivative."""
    found = np.asarray(control, dtype=np.longdouble)
    for start in state[::-1]:
        steps = found * (np.longdouble(duration) / len(found))
        found = np.concatenate([[np.longdouble(start)], steps]).cumsum(dtype=np.longdouble)
    return found


def halve_control(control: Wide) -> tuple[Wide, Wide]:
    """Control points on both halves of [0, 1]."""
    left, right = [control[0]], [control[-1]]
    while len(control) > 1:
        control = np.asarray((control[:-1] + control[1:]) / 2, dtype=np.longdouble)
        left.append(control[0])
        right.append(control[-1])
    return np.array(left), np.array(right[::-1])


def _binomials(n: int) -> Wide:
    return np.array([comb(n, i) for i in range(n + 1)], dtype=np.longdouble)
