"""Polynomials of polynomials, and products of stacks, in Bernstein form."""

from itertools import pairwise
from math import comb

import numpy as np

from timelaw.numerics.array import Array


def multiply_control(a: Array, b: Array) -> Array:
    """Control points (m+n+1, ...) of a product, a (m+1,) a scalar, b (n+1, ...) a scalar or a vector."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    m, n = len(a) - 1, len(b) - 1
    rows = b.reshape(n + 1, -1)
    left = a * _binomials(m)
    weighted = rows * _binomials(n)[:, None]
    product = np.stack([np.convolve(left, column) for column in weighted.T], axis=1)
    return np.asarray((product / _binomials(m + n)[:, None]).reshape(m + n + 1, *b.shape[1:]))


def compose_control(outer: Array, inner: Array) -> Array:
    """Control points (nm+1, ...) of p(f), p by `outer` (n+1, ...), f by `inner` (m+1,), both over [0, 1].

    De Casteljau's scheme with the polynomial f in place of a number: means of means, which lose no digits
    while f stays between 0 and 1.
    """
    inner = np.asarray(inner, dtype=float)
    rest = 1.0 - inner
    level = [np.asarray(point, dtype=float)[None] for point in outer]
    while len(level) > 1:
        level = [multiply_control(rest, a) + multiply_control(inner, b) for a, b in pairwise(level)]
    return level[0]


def _binomials(n: int) -> Array:
    return np.array([comb(n, i) for i in range(n + 1)], dtype=float)
