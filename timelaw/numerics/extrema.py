"""Proved bounds on max |p(u)| over [0, 1] for polynomials in Bernstein form.

A polynomial lies in the hull of its control points. Halving it tightens the hull quadratically,
so branch and bound closes in on the extremum from both sides. No sampling is involved. Every
halving is a rounded mean of control points, so each piece carries a bound on its own errors.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

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


def enclose_polynomials(polynomials: Sequence[Array]) -> list[Peak]:
    """Enclose max |p| of each polynomial, given by control points (n+1,); in the given order.

    A polynomial with a control point that is not finite has an infinite peak.
    """
    by_degree: dict[int, list[int]] = defaultdict(list)
    found: dict[int, Peak] = {}
    for index, control in enumerate(polynomials):
        if np.all(np.isfinite(control)):
            by_degree[len(control) - 1].append(index)
        else:
            found[index] = Peak(float("inf"), float("inf"), 0.0)
    for degree, indices in by_degree.items():
        stack = np.stack([polynomials[i] for i in indices])
        found.update(zip(indices, _branch_and_bound(stack, degree), strict=True))
    return [found[i] for i in range(len(polynomials))]


def _branch_and_bound(stack: Array, degree: int) -> list[Peak]:
    """Peaks of all rows of `stack` (m, n+1) at once; pieces that cannot hold the peak drop out."""
    count, rounding = len(stack), 2 * (degree + 2) * UNIT_ROUNDOFF
    lower, upper, at = np.zeros(count), np.zeros(count), np.zeros(count)
    pieces, owner, error = stack, np.arange(count), np.zeros(count)
    start, width = np.zeros(count), 1.0
    for depth in range(DEPTH + 1):
        for column, place in ((0, start), (-1, start + width)):
            value = np.abs(pieces[:, column]) - error
            order = np.argsort(value, kind="stable")  # the largest is written last
            better = order[value[order] > lower[owner[order]]]
            lower[owner[better]], at[owner[better]] = value[better], place[better]
        hull = np.max(np.abs(pieces), axis=1)
        # where errors are larger than what halving could still gain, a piece is done
        open_ = hull > np.maximum(lower[owner] * (1 + GAP), FLOOR) + error
        if depth == DEPTH or np.count_nonzero(open_) > MOST_PIECES * count:
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
    return [Peak(float(lo), float(max(lo, up)), float(a)) for lo, up, a in zip(lower, upper, at, strict=True)]
