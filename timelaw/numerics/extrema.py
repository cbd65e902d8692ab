"""Proved bounds on max |p(u)| over [0, 1] for polynomials in Bernstein form.

A polynomial lies in the hull of its control points. Halving it tightens the hull quadratically,
so branch and bound closes in on the extremum from both sides: `lower` is a value the polynomial
takes, `upper` one it never exceeds. No sampling is involved.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.bernstein import UNIT_ROUNDOFF, halving

Array = NDArray[np.float64]

GAP = 1e-13  # relative gap at which a bound is tight: a few hundred rounding errors
DEPTH = 48  # halvings; 2^-48 resolves any extremum a double can tell apart


@dataclass(frozen=True)
class Peak:
    """max |p| on [0, 1]: attained value `lower` at `at`, proved bound `upper`."""

    lower: float
    upper: float
    at: float


def peaks(polynomials: Sequence[Array]) -> list[Peak]:
    """Enclose max |p| of each polynomial, given by control points (n+1,); in the given order."""
    by_degree: dict[int, list[int]] = defaultdict(list)
    for index, control in enumerate(polynomials):
        by_degree[len(control) - 1].append(index)
    found: dict[int, Peak] = {}
    for degree, indices in by_degree.items():
        stack = np.stack([polynomials[i] for i in indices])
        found.update(zip(indices, _branch_and_bound(stack, degree), strict=True))
    return [found[i] for i in range(len(polynomials))]


def _branch_and_bound(stack: Array, degree: int) -> list[Peak]:
    """Peaks of all rows of `stack` (m, n+1) at once; pieces that cannot hold the peak drop out."""
    count = len(stack)
    lower, upper, at = np.full(count, -1.0), np.zeros(count), np.zeros(count)
    pieces, owner = stack, np.arange(count)
    start, width = np.zeros(count), 1.0
    for depth in range(DEPTH + 1):
        for column, place in ((0, start), (-1, start + width)):
            value = np.abs(pieces[:, column])
            order = np.argsort(value, kind="stable")  # the largest is written last
            better = order[value[order] > lower[owner[order]]]
            lower[owner[better]], at[owner[better]] = value[better], place[better]
        hull = np.max(np.abs(pieces), axis=1)
        open_ = hull > lower[owner] * (1 + GAP)
        np.maximum.at(upper, owner[~open_], hull[~open_])
        if depth == DEPTH or not np.any(open_):
            np.maximum.at(upper, owner[open_], hull[open_])
            break
        width /= 2
        halves = pieces[open_] @ halving(degree).T
        pieces = halves.reshape(-1, degree + 1)
        owner = np.repeat(owner[open_], 2)
        start = np.repeat(start[open_], 2)
        start[1::2] += width
    rounding = 1 + 4 * (degree + 1) * (depth + 1) * UNIT_ROUNDOFF  # each halving is a rounded mean
    return [
        Peak(float(lo), float(max(lo, up)) * rounding, float(a))
        for lo, up, a in zip(lower, upper, at, strict=True)
    ]
