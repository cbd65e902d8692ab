"""Quaternion polynomials Q(t), not normalised: orientation Q/|Q| and its rates, as numbers and polynomials.

With D = Q·Q, v(a, b) = Vec(ā b) and N = 2 v(Q, Q'): ω = N/D [HZ2019].
"""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from math import comb

import numpy as np

from timelaw.motion.curve_form import CurveForm, Index, derive_square, derive_turning
from timelaw.numerics.array import Array, freeze
from timelaw.numerics.bernstein import differentiate, evaluate
from timelaw.numerics.polynomial import PolynomialStack

HIGHEST = 4  # derivatives of Q: snap needs so many
QUADRATURE = 24  # nodes
TOGETHER = 512  # pieces: enough for NumPy, and little memory


@dataclass(frozen=True)
class QuaternionCurve:
    """One piece: Q over `duration` h [s] by its control points (d+1, 4)."""

    duration: float
    control: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "control", freeze(self.control))

    def __call__(self, u: Array, order: int) -> Array:
        """At u = t/h (m,): unit quaternions (m, 4) for order 0, else ω, α, jerk, snap (m, 3).

        Not finite where Q is zero.
        """
        with np.errstate(divide="ignore", invalid="ignore"):
            q = _derive(self._level, np.array(self.duration), np.asarray(u), order)
            return np.moveaxis(find_rates(q)[order], 0, -1).copy()

    def squares(self, u: Array, order: int) -> list[Array]:
        """D and its first derivatives (m,) in time at u (m,), of Q over the power of two."""
        q = _derive(self._level, np.array(self.duration), np.asarray(u), order)
        return [derive_square(q, k) for k in range(order + 1)]

    @cached_property
    def exponent(self) -> int:
        """Of the power of two that Q is divided by."""
        return int(np.frexp(np.max(np.abs(self.control)))[1])

    @cached_property
    def _level(self) -> Array:
        return _level(self.control)


@dataclass(frozen=True)
class CurveStack:
    """Pieces of one degree: numbers (m,), durations h [s] (m,), and control points (m, d+1, 4), levelled."""

    piece: Index
    duration: Array
    control: Array

    def find_ends(self) -> Array:
        """ω, α, jerk, snap (4, m, 2, 3) at both ends of each."""
        rows = np.arange(len(self.piece))
        return self._find_rates(rows, np.tile([0.0, 1.0], (len(rows), 1)))

    def sum_rates(self) -> Array:
        """∫ |rate| dt (4, m), by quadrature where D is even: no spike stands for all of its piece."""
        nodes, weights = _quadrature()
        form = self.form.split()
        width = form.end - form.start
        rates = self._find_rates(form.piece, form.start[:, None] + width[:, None] * nodes)
        terms = np.linalg.norm(rates, axis=-1) @ weights * (form.duration * width)
        return np.array([np.bincount(form.piece, row, len(self.piece)) for row in terms])

    def _find_rates(self, rows: Index, u: Array) -> Array:
        """Of the pieces in some rows (n,) at u = t/h (n, k): (4, n, k, 3)."""
        with np.errstate(divide="ignore", invalid="ignore"):
            q = _derive(self.control[rows], self.duration[rows], u, HIGHEST)
            return np.moveaxis(np.array(find_rates(q)[1:]), 1, -1)

    @cached_property
    def form(self) -> CurveForm:
        """The whole pieces as polynomials; they are called by their rows."""
        rows = np.arange(len(self.piece))
        parts = [PolynomialStack(self.control[:, :, k], np.zeros(len(rows))) for k in range(4)]
        derivatives = [parts]
        for _ in range(HIGHEST):
            parts = [part.derive() for part in parts]
            derivatives.append(parts)
        return CurveForm(rows, self.duration, np.zeros(len(rows)), np.ones(len(rows)), tuple(derivatives))


def stack_curves(curves: Sequence[QuaternionCurve]) -> Iterator[CurveStack]:
    """Those of one degree together, called by their numbers; not more than memory has room for."""
    by_degree: dict[int, list[int]] = defaultdict(list)
    for number, curve in enumerate(curves):
        by_degree[len(curve.control)].append(number)
    for numbers in by_degree.values():
        for first in range(0, len(numbers), TOGETHER):
            own = numbers[first : first + TOGETHER]
            control = _level(np.stack([curves[k].control for k in own]))
            yield CurveStack(np.array(own), np.array([curves[k].duration for k in own]), control)


@cache
def _quadrature() -> tuple[Array, Array]:
    """Gauss-Legendre nodes and weights on [0, 1]: for means that judge jumps, and prove nothing."""
    nodes, weights = np.polynomial.legendre.leggauss(QUADRATURE)
    return (nodes + 1) / 2, weights / 2


def _level(control: Array) -> Array:
    """Control points over a power of two, which turns nothing; the largest component from 1/2 to 1."""
    _, exponent = np.frexp(np.max(np.abs(control), axis=(-2, -1), keepdims=True))
    return np.asarray(np.ldexp(control, -exponent))


def differentiate_curves(control: Array, duration: Array, order: int) -> Array:
    """Control points (..., 4, n+1) of the k-th derivative in time of curves (..., d+1, 4)."""
    columns = np.swapaxes(control, -1, -2)
    return np.asarray(differentiate(columns, order) / duration[..., None, None] ** order)


def _derive(control: Array, duration: Array, u: Array, highest: int) -> list[Array]:
    """Q (4, ..., m) and its derivatives in time at u (..., m)."""
    points = (differentiate_curves(control, duration, order) for order in range(highest + 1))
    return [evaluate(np.moveaxis(own, -2, 0)[..., None, :], u) for own in points]


def find_rates(q: Sequence[Array]) -> list[Array]:
    """Orientation (4, ...), ω, α, … (3, ...) from Q (4, ...) and its derivatives.

    The derivatives of N = ω D by Leibniz' rule, solved for the highest of ω.
    """
    square = [derive_square(q, k) for k in range(max(len(q) - 1, 1))]
    found = [q[0] / np.sqrt(square[0])]
    for k in range(len(q) - 1):
        rate = np.array(derive_turning(q, k))
        for i, lower in enumerate(found[1:]):
            rate -= lower * (square[k - i] * float(comb(k, i)))
        found.append(rate / square[0])
    return found
