"""Splines: polynomials of low degree on many intervals, as smooth at the breaks as their degree allows.

Equal intervals cannot resolve a short ramp, so the breaks are placed on the phases of the double-S
profile, each phase divided further. Of degree 3 they contain that profile itself.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from timelaw.easing.profile import Piece, Profile
from timelaw.easing.spline_rates import expand_spline
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import basis_matrix, hermite_matrix, smooth_ends

PER_DEGREE = 4  # points per degree and interval on which extrema are looked for
FITTED_ORDERS = (1, 2)  # derivatives in which a given easing is approximated


@dataclass(frozen=True)
class SplineBasis:
    """Control points of all intervals, stacked, as L g(0) + M x + R g(1), like `PolynomialBasis`.

    `degree` p, `breaks` (n+1,) from 0 to 1, `continuity` r < p at the ends of the leg; inside, the
    first p - 1 derivatives are continuous. n + p - 2r - 2 coefficients are free. `sizes` are typical
    first to third derivatives, to scale them.
    """

    degree: int
    breaks: tuple[float, ...]
    continuity: int
    sizes: tuple[float, float, float] = (2.0, 8.0, 60.0)

    @property
    def free(self) -> int:
        """Number of free coefficients per leg."""
        return len(self.breaks) - 1 + self.degree - 2 * (self.continuity + 1)

    @cached_property
    def _bezier(self) -> Array:
        """Matrix (n (p+1), n + p): B-spline coefficients to stacked control points."""
        knots = np.concatenate([[0.0] * self.degree, self.breaks, [1.0] * self.degree])
        count = len(self.breaks) - 1
        rows = [_extraction(knots, self.degree + i, self.degree, count + self.degree) for i in range(count)]
        return np.concatenate(rows)

    def _ends(self) -> tuple[Array, Array]:
        """First and last B-spline coefficients (r+1) from the derivatives at the ends of the leg."""
        r, p = self.continuity, self.degree
        widths = np.diff(self.breaks)
        first = self._bezier[: r + 1, : r + 1]
        last = self._bezier[-r - 1 :, -r - 1 :]
        scale = hermite_matrix(p, r + 1)
        left = np.linalg.solve(first, scale * widths[0] ** np.arange(r + 1))
        mirrored = scale * (-widths[-1]) ** np.arange(r + 1.0)
        return left, np.linalg.solve(last, mirrored[::-1])

    @cached_property
    def from_left(self) -> Array:
        """L (n (p+1), r+1)."""
        return self._outer[0] + self.from_free @ self._lifts[0]

    @cached_property
    def from_right(self) -> Array:
        """R (n (p+1), r+1)."""
        return self._outer[1] + self.from_free @ self._lifts[1]

    @cached_property
    def _outer(self) -> tuple[Array, Array]:
        """The same (n (p+1), r+1) with no coefficients but those that the derivatives at an end determine."""
        left, right = self._ends()
        return self._bezier[:, : self.continuity + 1] @ left, self._bezier[:, -self.continuity - 1 :] @ right

    @cached_property
    def _lifts(self) -> tuple[Array, Array]:
        """What derivatives at the ends add to x (free, r+1), so that L and R are smooth all over the leg.

        They come near the polynomials of degree 2r + 1. Without, a change of the rate at a node would bend a
        spline of many intervals so sharply there that the solver could change it by little at a time.
        """
        tau, weights = self.quadrature()
        first, odd = smooth_ends(self.continuity), (-1.0) ** np.arange(self.continuity + 1)
        both = np.concatenate([first, first[:, ::-1] * odd[:, None]])
        fixed = np.concatenate(self._outer, axis=1)
        rows, targets = [], []
        for order, size in enumerate(self.sizes, 1):
            matrix, scale = self.values(tau, order), np.sqrt(weights)[:, None] / size
            wanted = basis_matrix(both.shape[1] - 1, tau, order) @ both.T
            rows.append(scale * (matrix @ self.from_free))
            targets.append(scale * (wanted - matrix @ fixed))
        found = np.linalg.lstsq(np.concatenate(rows), np.concatenate(targets), rcond=None)[0]
        return found[:, : self.continuity + 1], found[:, self.continuity + 1 :]

    @cached_property
    def _inner(self) -> Array:
        return self._bezier[:, self.continuity + 1 : self._bezier.shape[1] - self.continuity - 1]

    @cached_property
    def from_free(self) -> Array:
        """M (n (p+1), free): B-splines scaled so that each moves some rate by about its size.

        Intervals differ in width by orders of magnitude, and so do the plain B-splines in their
        effect. A basis made orthonormal, as for polynomials, would lose what makes splines fast:
        each reaches over a few intervals only.
        """
        return np.array(self._inner / self._effects)

    @cached_property
    def _effects(self) -> Array:
        effects = [
            np.max(np.abs(self._derivative_matrix(self.points([k]), k) @ self._inner), axis=0) / size
            for k, size in enumerate(self.sizes, 1)
        ]
        return np.array(np.max(effects, axis=0))

    def easing(self, left: Array, free: Array, right: Array) -> Profile:
        """The easing with the coefficients x and exactly the derivatives g(0) and g(1) (r+1,) at its ends."""
        inner = (free + self._lifts[0] @ left + self._lifts[1] @ right) / self._effects
        states, controls = expand_spline(self.breaks, self.degree, left, inner, right)
        return Profile(tuple(map(Piece, np.diff(self.breaks).tolist(), states, controls)))

    def values(self, tau: ArrayLike, order: int) -> Array:
        """Matrix (m, n (p+1)) that takes stacked control points to the k-th derivative at τ (m,).

        A point on a break counts for the interval on its right, unless it is the last.
        """
        return self._derivative_matrix(np.asarray(tau, dtype=float), order)

    def _derivative_matrix(self, tau: Array, order: int) -> Array:
        breaks = np.array(self.breaks)
        at = np.clip(np.searchsorted(breaks, tau, side="right") - 1, 0, len(breaks) - 2)
        widths = np.diff(breaks)[at]
        local = np.clip((tau - breaks[at]) / widths, 0.0, 1.0)
        block = basis_matrix(self.degree, local, order) / widths[:, None] ** order
        matrix = np.zeros((len(tau), (len(breaks) - 1) * (self.degree + 1)))
        columns = at[:, None] * (self.degree + 1) + np.arange(self.degree + 1)
        np.put_along_axis(matrix, columns, block, axis=1)
        return matrix

    def points(self, orders: Sequence[int]) -> Array:
        """Points at which to demand a limit first: as many per interval as its polynomial needs."""
        remaining = max(self.degree - min(orders), 0)
        return self._within(np.array([0.5]) if remaining == 0 else np.arange(remaining + 1) / remaining)

    def grid(self) -> Array:
        """Points fine enough to bracket every extremum of a rate."""
        return self._within(np.linspace(0.0, 1.0, PER_DEGREE * self.degree + 1))

    def _within(self, local: Array) -> Array:
        """The same local points in every interval, those on breaks once."""
        breaks = np.array(self.breaks)
        points = breaks[:-1, None] + np.diff(breaks)[:, None] * local
        return np.unique(points)

    def quadrature(self) -> tuple[Array, Array]:
        """Nodes and weights on [0, 1], exact for the fourth power of the easing."""
        nodes, weights = np.polynomial.legendre.leggauss(2 * self.degree)
        widths = np.diff(self.breaks)
        tau = np.array(self.breaks)[:-1, None] + widths[:, None] * (nodes + 1) / 2
        return tau.ravel(), (widths[:, None] * weights / 2).ravel()

    def free_of(self, easing: Profile) -> Array:
        """The free coefficients with which the spline comes nearest to an easing's first derivatives."""
        left, right = ([float(easing(end, i)) for i in range(self.continuity + 1)] for end in (0.0, 1.0))
        fixed = self.from_left @ left + self.from_right @ right
        tau, weights = self.quadrature()
        rows, targets = [], []
        for order in FITTED_ORDERS:
            matrix, target = self.values(tau, order), easing(tau, order)
            scale = np.sqrt(weights) / max(float(np.max(np.abs(target))), 1e-12)
            rows.append(scale[:, None] * (matrix @ self.from_free))
            targets.append(scale * (target - matrix @ fixed))
        return np.linalg.lstsq(np.concatenate(rows), np.concatenate(targets), rcond=None)[0]


def _extraction(knots: Array, left: int, degree: int, count: int) -> Array:
    """Control points on [knots[left], knots[left+1]] from B-spline coefficients, by blossoming."""
    a, b = knots[left], knots[left + 1]
    rows = np.zeros((degree + 1, count))
    for j in range(degree + 1):
        arguments = [a] * (degree - j) + [b] * j
        points = np.eye(count)[left - degree : left + 1]
        for level in range(1, degree + 1):
            t = arguments[level - 1]
            for i in range(degree, level - 1, -1):
                low, high = knots[left - degree + i], knots[left + 1 + i - level]
                share = (t - low) / (high - low)
                points[i] = (1 - share) * points[i - 1] + share * points[i]
        rows[j] = points[degree]
    return rows
