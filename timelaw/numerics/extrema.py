"""Proved bounds on max |p(u)| over [0, 1] for polynomials in Bernstein form.

A polynomial lies in the hull of its control points. Halving it tightens the hull quadratically,
so branch and bound closes in on the extremum from both sides. No sampling is involved. Every
halving is a rounded mean of control points, so each piece carries a bound on its own errors.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import UNIT_ROUNDOFF, halving_matrix

GAP = 1e-13  # relative gap at which a bound is tight: a few hundred rounding errors
FLOOR = 1e-290  # sizes below count as equal: subnormal numbers have no relative precision
DEPTH = 48  # halvings; 2^-48 resolves any extremum a double can tell apart
MOST_PIECES = 4096  # open pieces per polynomial; beyond it the hull, a bound as well, is taken


@dataclass(frozen=True)
class Peak:
    """max |p| on [0, 1] lies between `lower` and `upper`, rounding included; it is near `at`."""

    lower: float
    upper: float
    at: float


@dataclass(frozen=True)
class Peaks:
    """Those of many polynomials, each of the three (m,)."""

    lower: Array
    upper: Array
    at: Array

    def list_each(self) -> list[Peak]:
        """One by one."""
        return list(map(Peak, self.lower.tolist(), self.upper.tolist(), self.at.tolist()))


def enclose_polynomials(polynomials: Sequence[Array]) -> list[Peak]:
    """Enclose max |p| of each polynomial, given by control points (n+1,); in the given order."""
    by_degree: dict[int, list[int]] = defaultdict(list)
    found: dict[int, Peak] = {}
    for index, control in enumerate(polynomials):
        by_degree[len(control)].append(index)
    for indices in by_degree.values():
        peaks = enclose_stack(np.stack([polynomials[i] for i in indices]))
        found.update(zip(indices, peaks.list_each(), strict=True))
    return [found[i] for i in range(len(polynomials))]


def enclose_stack(control: Array) -> Peaks:
    """Enclose max |p| of each row of control points (m, n+1); infinite where one of them is not finite."""
    count = len(control)
    finite = np.flatnonzero(np.all(np.isfinite(control), axis=1))
    if len(finite) == count:
        return _branch_and_bound(control, np.arange(count), count)
    peaks = Peaks(np.full(count, np.inf), np.full(count, np.inf), np.zeros(count))
    known = _branch_and_bound(control[finite], np.arange(len(finite)), len(finite))
    for whole, part in ((peaks.lower, known.lower), (peaks.upper, known.upper), (peaks.at, known.at)):
        whole[finite] = part
    return peaks


def find_largest(control: Array) -> float:
    """A value that the largest |p| of all rows of control points (m, n+1) takes, within the gap of it."""
    if not np.all(np.isfinite(control)):
        return float("inf")
    return float(_branch_and_bound(control, np.zeros(len(control), dtype=int), 1).lower[0])


def _branch_and_bound(stack: Array, owner: NDArray[np.int64], count: int) -> Peaks:
    """Peaks of `count` sets of rows (m, n+1), `owner` (m,) saying whose each is, all at once.

    Pieces that cannot hold the peak drop out.
    """
    degree = stack.shape[1] - 1
    rounding = 2 * (degree + 2) * UNIT_ROUNDOFF
    lower, upper, at = np.zeros(count), np.zeros(count), np.zeros(count)
    pieces, error = stack, np.zeros(len(stack))
    start, width = np.zeros(len(stack)), 1.0
    for depth in range(DEPTH + 1):
        for column, place in ((0, start), (-1, start + width)):
            value = np.abs(pieces[:, column]) - error
            order = np.argsort(value, kind="stable")  # the largest is written last
            better = order[value[order] > lower[owner[order]]]
            lower[owner[better]], at[owner[better]] = value[better], place[better]
        hull = np.max(np.abs(pieces), axis=1)
        # where errors are larger than what halving could still gain, a piece is done
        open_ = hull > np.maximum(lower[owner] * (1 + GAP), FLOOR) + error
        if depth == DEPTH or np.count_nonzero(open_) > MOST_PIECES * len(stack):
            open_[:] = False
        np.maximum.at(upper, owner[~open_], (hull + error)[~open_])
        if not np.any(open_):
            break
        width /= 2
        error = np.repeat(error[open_] + rounding * hull[open_], 2)
        pieces = (pieces[open_] @ halving_matrix(degree).T).reshape(-1, degree + 1)
        owner = np.repeat(owner[open_], 2)
        start = np.repeat(start[open_], 2)
        start[1::2] += width
    return Peaks(lower, np.maximum(lower, upper), at)
