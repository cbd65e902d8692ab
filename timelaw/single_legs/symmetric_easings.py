"""Easings that equal their mirror images, f(1 - τ) = 1 - f(τ): the ones among which the fastest is.

Limits on |φ^(k)| do not tell a law from its mirror image, and the mean of two laws that hold them in the same
time holds them too. So half of the coefficients are all there is to choose, and half of the leg to look at.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev

from timelaw.easing import Profile
from timelaw.easing.polynomial_basis import CONDITIONED_ORDER, SIZE, PolynomialBasis
from timelaw.numerics.array import Array, freeze

POINTS_PER_DEGREE = 8  # of a whole leg: every extremum shows between two of them
ORDERS = 7  # derivatives: of the fourth rate, the extrema and their curvature


@dataclass(frozen=True)
class SymmetricEasings:
    """f = e_0 + Σ x_i e_i of `degree` with r = `continuity` derivatives zero at both ends.

    e_0 is the smoothstep. In z = 2τ - 1 all are odd but for the constant; e_i has the factor (1 - z²)^(r+1).
    """

    degree: int
    continuity: int

    @property
    def free(self) -> int:
        """Number n of what may be chosen."""
        return max((self.degree - 2 * self.continuity - 1) // 2, 0)

    @cached_property
    def derivatives(self) -> tuple[Array, ...]:
        """For each order the Chebyshev coefficients (n+1, d+1) in z of e_0^(k), e_1^(k), …, derived by τ."""
        start = np.zeros((1, self.degree + 1))
        bell = chebyshev.chebpow(chebyshev.poly2cheb([1.0, 0.0, -1.0]), self.continuity)
        rise = chebyshev.chebint(bell, lbnd=-1)
        start[0, : len(rise)] = rise / chebyshev.chebval(1.0, rise)
        found = np.concatenate([start, self._directions])
        orders = [found]
        for _ in range(1, ORDERS):
            found = np.pad(2.0 * chebyshev.chebder(found, axis=1), ((0, 0), (0, 1)))
            orders.append(found)
        return tuple(freeze(order) for order in orders)

    @cached_property
    def _directions(self) -> Array:
        """Chebyshev coefficients (n, d+1), orthonormal in their third derivatives but for the size."""
        wide = chebyshev.chebpow(chebyshev.poly2cheb([1.0, 0.0, -1.0]), self.continuity + 1)
        plain = np.zeros((self.free, self.degree + 1))
        for i, row in enumerate(plain):
            product = chebyshev.chebmul(wide, np.eye(2 * i + 2)[-1])
            row[: len(product)] = product
        values = 2.0**CONDITIONED_ORDER * chebyshev.chebval(
            self.grid, chebyshev.chebder(plain, CONDITIONED_ORDER, axis=1).T
        )
        triangle = np.linalg.qr(values.T)[1] if self.free else np.zeros((0, 0))
        return np.asarray(np.linalg.solve(triangle.T, plain) * SIZE)

    @cached_property
    def grid(self) -> Array:
        """Points z in [-1, 0], the first half of a leg."""
        half = POINTS_PER_DEGREE * self.degree // 2
        return freeze(-np.cos(np.pi / 2 * np.arange(half + 1) / half))

    @cached_property
    def on_grid(self) -> tuple[Array, ...]:
        """For each order the values (n+1, m) of e_0^(k), e_1^(k), … on the grid."""
        return tuple(freeze(rates @ self.expand(self.grid).T) for rates in self.derivatives)

    def expand(self, z: Array) -> Array:
        """Chebyshev polynomials (..., d+1) at z (...)."""
        return np.asarray(chebyshev.chebvander(z, self.degree))

    def write_in(self, basis: PolynomialBasis, chosen: Array) -> list[Profile]:
        """The easings x (m, n) as profiles of a basis that contains them."""
        tau = basis.points([CONDITIONED_ORDER])
        values = self.derivatives[CONDITIONED_ORDER] @ self.expand(2 * tau - 1).T
        rest = np.zeros(self.continuity + 1)
        end = np.eye(self.continuity + 1)[0]
        free = basis.free_from(values[0] + chosen @ values[1:], rest, end)
        return basis.list_easings(rest, free, end)
