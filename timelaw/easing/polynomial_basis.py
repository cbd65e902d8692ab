"""One polynomial per leg, of any degree ≥ 2r + 1, as a linear map of what the solver may choose."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from timelaw.easing.joining import join_pieces
from timelaw.easing.profile import Piece, Profile
from timelaw.numerics.array import Array, freeze
from timelaw.numerics.bernstein import (
    basis_matrix,
    differentiate,
    elevate,
    halving_matrix,
    smooth_ends,
)
from timelaw.numerics.state_form import derive

CONDITIONED_ORDER = 3  # the highest derivative that is limited depends most wildly on control points
GRID = 8  # points per degree on which extrema are looked for
MOST_PIECES = 16
SAMPLES = 64  # steps between those of a rate, to know its size
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
        """L (d+1, r+1): of the polynomials of degree 2r + 1 with one derivative at one end, and no other.

        Were they zero but for the first control points, a change of the rate at a node would bend the legs
        so sharply there that the solver could change it by little at a time.
        """
        return np.ascontiguousarray(elevate(smooth_ends(self.continuity), self.degree).T)

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
        return (self.from_left * (-1.0) ** np.arange(self.continuity + 1))[::-1]

    def easing(self, left: Array, free: Array, right: Array) -> Profile:
        """The easing with the coefficients x and exactly the derivatives g(0) and g(1) (r+1,) at its ends."""
        return self.list_easings(left, free[None], right)[0]

    def list_easings(self, left: Array, free: Array, right: Array) -> list[Profile]:
        """Easings with coefficients x (m, free), all with the same derivatives at their ends."""
        control = np.tile(self.from_left @ left + self.from_right @ right, (len(free), 1))
        # loses less than its inverse
        control[:, self._inner] += np.linalg.solve(self._effect[1], SIZE * free.T).T
        pieces = differentiate(control, self.continuity + 1)[:, None]
        found, open_ = dict[int, Profile](), np.arange(len(free))
        while len(open_):
            count = pieces.shape[1]
            widths = np.full(count, 1 / count)
            states, controls = join_pieces(widths, pieces, left, right, smooth=count > 1)
            done = _are_well_rounded(widths, states, controls) | (count >= MOST_PIECES)
            for i in np.flatnonzero(done):
                found[int(open_[i])] = Profile(tuple(map(Piece, widths.tolist(), states[i], controls[i])))
            open_, pieces = open_[~done], pieces[~done]
            pieces = (pieces @ halving_matrix(pieces.shape[2] - 1).T).reshape(
                len(open_), 2 * count, pieces.shape[2]
            )
        return [found[i] for i in range(len(free))]

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
        orders = range(self.continuity + 1)
        left, right = (np.array([float(easing(end, i)) for i in orders]) for end in (0.0, 1.0))
        tau = self.points([CONDITIONED_ORDER])
        return self.free_from(easing(tau, CONDITIONED_ORDER), left, right)

    def free_from(self, values: Array, left: Array, right: Array) -> Array:
        """X (..., free) of easings from their third derivatives (..., m) at its points."""
        ends = self.from_left @ left + self.from_right @ right
        fixed = self.values(self.points([CONDITIONED_ORDER]), CONDITIONED_ORDER) @ ends
        return np.asarray((values - fixed) @ self._effect[0] / SIZE)


def _are_well_rounded(durations: Array, states: Array, controls: Array) -> NDArray[np.bool_]:
    """Whether the rates of each are known to far less than what counts as a jump (m,).

    High derivatives of high degree have control points far beyond their values, which halving brings down.
    """
    count, pieces, size = states.shape
    stacked = np.tile(durations, count), states.reshape(-1, size), controls.reshape(count * pieces, -1)
    well = np.full(count, True)
    for order in range(1, size):
        rates, error = derive(*stacked, order)
        samples = rates @ _sampling(rates.shape[1] - 1, SAMPLES // pieces)
        largest = np.max(np.abs(samples).reshape(count, -1), axis=1)
        well &= np.max(error.reshape(count, -1), axis=1) <= WELL_ROUNDED * largest
    return well


@cache
def _sampling(degree: int, steps: int) -> Array:
    """Matrix (d+1, m) from control points to values at equal steps."""
    return freeze(basis_matrix(degree, np.linspace(0.0, 1.0, steps + 1)).T)


def _chebyshev(intervals: int) -> Array:
    return np.array((1 - np.cos(np.pi * np.arange(intervals + 1) / intervals)) / 2)
