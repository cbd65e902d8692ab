"""One polynomial per leg, of any degree ≥ 2r + 1, as a linear map of what the solver may choose."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from timelaw.easing.joining import join_pieces
from timelaw.easing.profile import Profile
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import basis_matrix, differentiate, hermite_matrix, split

CONDITIONED_ORDER = 3  # the highest derivative that is limited depends most wildly on control points
GRID = 8  # points per degree on which extrema are looked for
MOST_PIECES = 16
SAMPLES = 65  # of a rate, to know its size
WELL_ROUNDED = 1e-11  # relative: what rounding may leave of a rate
SIZE = 100.0  # of that derivative, typically: the quintic's third derivative peaks at 60


@dataclass(frozen=True)
class PolynomialBasis:
    """Control points c = L g(0) + M x + R g(1) of an easing of `degree` d.

    g = (f, f', …, f^(r)) at an end of the leg, r = `continuity`; x (d - 2r - 1,) is free. The
    derivatives at the ends are met by construction, so no solver tolerance enters them.
    """

    degree: int
    continuity: int

    @property
    def free(self) -> int:
        """Number of free control points per leg."""
        return self.degree - 2 * self.continuity - 1

    @cached_property
    def from_left(self) -> Array:
        """L (d+1, r+1)."""
        return self._padded(hermite_matrix(self.degree, self.continuity + 1))

    @cached_property
    def from_free(self) -> Array:
        """M (d+1, d-2r-1): directions in which the third derivative changes independently.

        Single control points of degree 31 are almost linearly dependent in their effect on the
        third derivative; with M made orthonormal there, the solver needs far fewer iterations.
        """
        inner = np.zeros((self.degree + 1, self.free))
        inner[self._inner] = np.linalg.inv(self._effect[1]) * SIZE
        return inner

    @property
    def _inner(self) -> slice:
        return slice(self.continuity + 1, self.degree - self.continuity)

    @cached_property
    def _effect(self) -> tuple[Array, Array]:
        """Of inner control points on the third derivative at its points: Q R, Q with orthonormal columns."""
        effect = self.values(self.points([CONDITIONED_ORDER]), CONDITIONED_ORDER)[:, self._inner]
        orthonormal, triangle = np.linalg.qr(effect)
        return orthonormal, triangle

    @cached_property
    def from_right(self) -> Array:
        """R (d+1, r+1): the left end mirrored, τ → 1 - τ, so odd derivatives change sign."""
        sign = (-1.0) ** np.arange(self.continuity + 1)
        return self._padded(hermite_matrix(self.degree, self.continuity + 1) * sign)[::-1]

    def _padded(self, block: Array) -> Array:
        below = np.zeros((self.degree + 1 - len(block), block.shape[1]))
        return np.concatenate([block, below])

    def easing(self, left: Array, free: Array, right: Array) -> Profile:
        """The easing with the coefficients x and exactly the derivatives g(0) and g(1) (r+1,) at its ends."""
        control = self.from_left @ left + self.from_right @ right
        control[self._inner] += np.linalg.solve(self._effect[1], SIZE * free)  # loses less than its inverse
        pieces = [differentiate(control, self.continuity + 1)]
        while True:
            width = 1 / len(pieces)
            easing = join_pieces(
                np.full(len(pieces), width), np.array(pieces), left, right, smooth=len(pieces) > 1
            )
            if len(pieces) >= MOST_PIECES or _is_well_rounded(easing, self.continuity):
                return easing
            pieces = [half for piece in pieces for half in split(piece, 0.5)]

    def values(self, tau: ArrayLike, order: int) -> Array:
        """Matrix (m, d+1) that takes control points to the k-th derivative at the points τ (m,)."""
        return basis_matrix(self.degree, tau, order)

    def points(self, orders: Sequence[int]) -> Array:
        """Points in [0, 1] at which to demand a limit first: Chebyshev's, where extrema crowd at the ends.

        Twice as many as the polynomial of these rates has extrema, so that none hides between.
        """
        return _chebyshev(2 * (self.degree - min(orders)) + 2)

    def grid(self) -> Array:
        """Points fine enough to bracket every extremum of a rate."""
        return _chebyshev(GRID * self.degree)

    def quadrature(self) -> tuple[Array, Array]:
        """Nodes and weights on [0, 1], exact for the fourth power of the easing."""
        nodes, weights = np.polynomial.legendre.leggauss(2 * self.degree)
        return (nodes + 1) / 2, weights / 2

    def free_of(self, easing: Profile) -> Array:
        """The solver's variables x of a polynomial easing of at most this degree, in however many pieces.

        They are read off the third derivative, in which they are independent: what the ends leave of it.
        """
        left, right = ([float(easing(end, i)) for i in range(self.continuity + 1)] for end in (0.0, 1.0))
        tau = self.points([CONDITIONED_ORDER])
        fixed = self.values(tau, CONDITIONED_ORDER) @ (self.from_left @ left + self.from_right @ right)
        return np.array(self._effect[0].T @ (easing(tau, CONDITIONED_ORDER) - fixed) / SIZE)


def _is_well_rounded(easing: Profile, continuity: int) -> bool:
    """Whether the rates are known to far less than what counts as a jump.

    High derivatives of high degree have control points far beyond their values, which halving brings down.
    """
    tau = np.linspace(0.0, 1.0, SAMPLES)
    return all(
        max(rate.error for rate in easing.derivative(order))
        <= WELL_ROUNDED * float(np.max(np.abs(easing(tau, order))))
        for order in range(1, continuity + 1)
    )


def _chebyshev(intervals: int) -> Array:
    return np.array((1 - np.cos(np.pi * np.arange(intervals + 1) / intervals)) / 2)
