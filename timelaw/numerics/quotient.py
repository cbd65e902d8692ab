"""Quotients of polynomials on [0, 1], the denominator positive: values, and proved bounds.

With num = Σ a_i b_i, den = Σ d_i b_i of one degree and all d_i > 0, the quotient is a mean of the a_i/d_i
with weights d_i b_i/den: it lies in their hull, which halving tightens quadratically. Bounding numerator
and denominator apart would close in linearly only.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import inf

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import UNIT_ROUNDOFF, halving_matrix
from timelaw.numerics.extrema import FLOOR, GAP, MOST_PIECES, Peak
from timelaw.numerics.polynomial import Polynomial, PolynomialStack

DEPTH = 40  # halvings; by then a quotient of what doubles can tell apart is enclosed
QUADRATURE = 24  # Gauss-Legendre nodes for mean squares, which judge nothing that is proved


@dataclass(frozen=True)
class Quotient:
    """(num/den)^(1/root), den > 0 and num ≥ 0 where there is a root."""

    num: Polynomial
    den: Polynomial
    root: int = 1

    @property
    def degree(self) -> int:
        """Of numerator and denominator."""
        return max(self.num.degree, self.den.degree)

    def __call__(self, u: Array) -> Array:
        """Values at u (m,)."""
        quotient = self.num(u) / self.den(u)
        return quotient if self.root == 1 else np.asarray(np.maximum(quotient, 0.0) ** (1 / self.root))

    def integrate_square(self) -> float:
        """∫ f² du over [0, 1], by quadrature."""
        nodes, weights = _quadrature()
        return float(weights / 2 @ self((nodes + 1) / 2) ** 2)

    @classmethod
    def enclose_all(cls, functions: Sequence["Quotient"]) -> list[Peak]:
        """Max |f| of each on [0, 1], rounding in the upper bound.

        Infinite where den > 0 is not proved, or where a control point is beyond doubles.
        """
        by_degree: dict[int, list[int]] = defaultdict(list)
        found: dict[int, Peak] = {}
        for index, function in enumerate(functions):
            if function.num.finite and function.den.finite:
                by_degree[function.degree].append(index)
            else:
                found[index] = Peak(inf, inf, 0.0)
        for degree, indices in by_degree.items():
            nums = [functions[i].num.raised(degree) for i in indices]
            dens = [functions[i].den.raised(degree) for i in indices]
            for i, peak in zip(indices, _enclose(nums, dens), strict=True):
                found[i] = _take_root(peak, functions[i].root)
        return [found[i] for i in range(len(functions))]

    @classmethod
    def find_largest(cls, functions: Sequence["Quotient"]) -> float:
        """A value that the largest |f| of all takes; they are of one degree."""
        if not all(function.num.finite and function.den.finite for function in functions):
            return inf
        peaks = _enclose([f.num for f in functions], [f.den for f in functions], together=True)
        tops = zip(peaks, functions, strict=True)
        return max(_take_root(peak, function.root).lower for peak, function in tops)


@cache
def _quadrature() -> tuple[Array, Array]:
    return np.polynomial.legendre.leggauss(QUADRATURE)


def divide(num: PolynomialStack, den: PolynomialStack, root: int = 1) -> list[Quotient]:
    """(num/den)^(1/root) row by row, all in one form."""
    degree = max(num.degree, den.degree)
    rows = zip(num.raised(degree).list_rows(), den.raised(degree).list_rows(), strict=True)
    return [Quotient(one, two, root) for one, two in rows]


def _take_root(peak: Peak, root: int) -> Peak:
    if root == 1:
        return peak
    above = 1 + 4 * UNIT_ROUNDOFF
    return Peak(peak.lower ** (1 / root) / above, peak.upper ** (1 / root) * above, peak.at)


def _enclose(nums: Sequence[Polynomial], dens: Sequence[Polynomial], *, together: bool = False) -> list[Peak]:
    """Branch and bound on all quotients at once; boxes that cannot hold the peak drop out.

    `together`: the peak of all; what is found of the others is not tight.
    """
    count, degree = len(nums), nums[0].degree
    boxes = np.stack([[n.control, d.control] for n, d in zip(nums, dens, strict=True)])  # (m, 2, n+1)
    errors = np.array([[n.error, d.error] for n, d in zip(nums, dens, strict=True)])
    lower, upper, at = np.zeros(count), np.zeros(count), np.zeros(count)
    owner, start, width = np.arange(count), np.zeros(count), 1.0
    rounding = 2 * (degree + 2) * UNIT_ROUNDOFF
    for depth in range(DEPTH + 1):
        _raise_lower(boxes, errors, owner, (start, start + width), lower, at)
        reached = np.full(len(owner), np.max(lower)) if together else lower[owner]
        hull, plain, loss = _bound(boxes, errors)
        # where rounding is more than halving could still gain, a box is done
        open_ = plain > np.maximum(reached * (1 + GAP), FLOOR) + loss
        # where the denominator is lost in rounding at a point there is no bound, however often it is halved
        lost = np.any(boxes[:, 1, [0, -1]] <= errors[:, 1, None], axis=1)
        open_ &= ~np.isin(owner, owner[lost])
        if depth == DEPTH or np.count_nonzero(open_) > MOST_PIECES * count:
            open_[:] = False
        np.maximum.at(upper, owner[~open_], hull[~open_])
        if not np.any(open_):
            break
        width /= 2
        sizes = np.max(np.abs(boxes[open_]), axis=2)
        errors = np.repeat(errors[open_] + rounding * sizes, 2, axis=0)
        halves = boxes[open_] @ halving_matrix(degree).T
        boxes = halves.reshape(-1, 2, 2, degree + 1).swapaxes(1, 2).reshape(-1, 2, degree + 1)
        owner, start = np.repeat(owner[open_], 2), np.repeat(start[open_], 2)
        start[1::2] += width
    above = 1 + 4 * UNIT_ROUNDOFF
    bounds = zip(lower.tolist(), upper.tolist(), at.tolist(), strict=True)
    return [Peak(low, max(low, high) * above, place) for low, high, place in bounds]


def _raise_lower(
    boxes: Array,
    errors: Array,
    owner: NDArray[np.int64],
    ends: tuple[Array, Array],
    lower: Array,
    at: Array,
) -> None:
    """Values that the quotients surely take at the ends of their boxes."""
    for column, place in ((0, ends[0]), (-1, ends[1])):
        num = np.maximum(np.abs(boxes[:, 0, column]) - errors[:, 0], 0.0)
        value = num / np.maximum(np.abs(boxes[:, 1, column]) + errors[:, 1], np.finfo(float).tiny)
        order = np.argsort(value, kind="stable")  # the largest is written last
        better = order[value[order] > lower[owner[order]]]
        lower[owner[better]], at[owner[better]] = value[better], place[better]


def _bound(boxes: Array, errors: Array) -> tuple[Array, Array, Array]:
    """For each box: the hull, rounding included; the hull without it; and what rounding makes of it.

    Infinite where a denominator's control point is not surely positive.
    """
    least = boxes[:, 1] - errors[:, 1, None]
    sure = np.all(least > 0, axis=1)
    safe = np.where(sure[:, None], least, 1.0)
    sizes = np.abs(boxes[:, 0])
    hull = np.max((sizes + errors[:, 0, None]) / safe, axis=1)
    plain = np.max(sizes / np.where(sure[:, None], boxes[:, 1], 1.0), axis=1)
    loss = (errors[:, 0] + plain * errors[:, 1]) / np.min(safe, axis=1)
    return np.where(sure, hull, np.inf), np.where(sure, plain, np.inf), np.where(sure, loss, 0.0)
