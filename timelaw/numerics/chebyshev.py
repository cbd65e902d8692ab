"""Polynomials on [0, 1] as Chebyshev series p(u) = Σ c_k T_k(2u - 1): many values in few passes over arrays.

The form for values alone: de Casteljau's scheme takes n² passes, Clenshaw's takes n, with the rounding of the
largest value on the piece. What is stored and proved stays in Bernstein form.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import comb

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array, freeze

Index = NDArray[np.intp]
Rows = slice | Index  # one row for all points, or one for each


def take_rows(table: Array, rows: Rows) -> Array:
    """Rows of a stack that stand along the last axis: one, or that of each point."""
    return np.asarray(table[..., rows] if isinstance(rows, slice) else table.take(rows, axis=-1))


@dataclass(frozen=True)
class Points:
    """Where polynomials are evaluated: `twice` (m,) 2(2u - 1); at `low` and `high` u is exactly 0 and 1."""

    twice: Array
    low: Index
    high: Index

    @classmethod
    def clip(cls, twice: Array, low: NDArray[np.bool_], high: NDArray[np.bool_]) -> "Points":
        """From 2(2u - 1) that rounding may lead out of [-2, 2]; `low` and `high` (m,) are ends for sure."""
        low, high = low | (twice <= -2.0), high | (twice >= 2.0)
        np.minimum(np.maximum(twice, -2.0, out=twice), 2.0, out=twice)
        return cls(twice, np.flatnonzero(low), np.flatnonzero(high))

    def take(self, here: Index) -> "Points":
        """Some of them."""
        numbers = np.full(len(self.twice), -1)
        numbers[here] = np.arange(len(here))
        low, high = numbers[self.low], numbers[self.high]
        return Points(self.twice[here], low[low >= 0], high[high >= 0])


@dataclass(frozen=True)
class ChebyshevStack:
    """N polynomials, or N curves by their components: `coefficients` (n+1, ..., N), their degrees (N,).

    `ends` (2, ..., N) are their values at 0 and 1, which are met exactly.
    """

    coefficients: Array
    degrees: Index
    ends: Array

    @classmethod
    def join(cls, controls: Sequence[tuple[Index, Array]]) -> "ChebyshevStack":
        """From control points (g, ..., n+1) of each degree, and the rows (g,) at which these should stand."""
        count = sum(len(rows) for rows, _ in controls)
        width, shape = max(c.shape[-1] for _, c in controls), controls[0][1].shape[1:-1]
        coefficients, ends = np.zeros((width, *shape, count)), np.empty((2, *shape, count))
        degrees = np.empty(count, dtype=np.intp)
        for rows, control in controls:
            degree = control.shape[-1] - 1
            series = control @ expand_basis(degree).T
            coefficients[: degree + 1, ..., rows] = np.moveaxis(series, (-1, 0), (0, -1))
            ends[..., rows] = np.moveaxis(control[..., [0, -1]], (-1, 0), (0, -1))
            degrees[rows] = degree
        return cls(coefficients, degrees, ends)

    def __call__(self, rows: Rows, points: Points) -> Array:
        """Values (..., m) at m points: of one row, or of the row of each."""
        value = self._sum(rows, points.twice, int(np.max(self.degrees[rows])))
        for end, places in ((0, points.low), (1, points.high)):
            if len(places):
                own = rows if isinstance(rows, slice) else rows[places]
                value[..., places] = self.ends[end][..., own]
        return value

    def _sum(self, rows: Rows, twice: Array, degree: int) -> Array:
        """Clenshaw: b_k = c_k + 2x b_(k+1) - b_(k+2), p = c_0 + x b_1 - b_2, in three arrays."""
        c = self.coefficients
        size = (*c.shape[1:-1], len(twice))
        if not degree:
            return np.array(np.broadcast_to(take_rows(c[0], rows), size))
        # before the first step b_(k+1) is c_n and b_(k+2) zero: two passes are left of it
        last, before, product = (np.empty(size) for _ in range(3))
        before[...] = take_rows(c[degree], rows)
        np.multiply(before, twice, out=last)
        if degree == 1:
            last *= 0.5
        last += take_rows(c[degree - 1], rows)
        for k in range(degree - 2, -1, -1):
            np.multiply(last, twice, out=product)
            if not k:
                product *= 0.5
            np.subtract(product, before, out=before)
            before += take_rows(c[k], rows)
            last, before = before, last
        return last


@cache
def expand_basis(degree: int) -> Array:
    """Matrix (n+1, n+1) from Bernstein control points to Chebyshev coefficients, each entry rounded once.

    u^k = 4^-k (C(2k, k) + 2 Σ_(i ≥ 1) C(2k, k - i) T_i), B_j = Σ_(k ≥ j) (-1)^(k+j) C(n, k) C(k, j) u^k.
    """
    n, whole = degree, range(degree + 1)
    powers = [
        [(1 + (i > 0)) * comb(2 * k, k - i) * 4 ** (n - k) if i <= k else 0 for k in whole] for i in whole
    ]
    bases = [[(-1) ** (k + j) * comb(n, k) * comb(k, j) for k in whole] for j in whole]
    entries = [
        [sum(p * b for p, b in zip(power, base, strict=True)) / 4**n for base in bases] for power in powers
    ]
    return freeze(np.array(entries))
