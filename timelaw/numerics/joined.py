"""Control points as doubles by which the derivatives of two pieces agree where they meet, to the last bit.

Rounded one by one, points of degree n on N pieces leave jumps of (2nN)^k of their rounding in the k-th
derivative: a hundred thousandth of a fourth one for n = 35, N = 12. On a common grid both sides can be given
the same differences, where one piece is a whole number of times as long as the other.
"""

from collections.abc import Sequence
from itertools import pairwise
from math import comb

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.composition import Wide

MOST_RATIO = 4  # of durations: the points near the joint move by up to (1 + 4)^k / 2 steps of the grid
SAME_RATIO = 1e-12  # that of two durations is taken for a whole number


def round_joined(pieces: Sequence[Wide], durations: Sequence[float], order: int) -> list[Array]:
    """Control points (n+1, d) over `durations`, rounded; where two meet, derivatives agree up to an order.

    With ∇^i l the last backward differences of the left piece in steps of the grid, rounded to whole numbers,
    and s = h_right/h_left, l_(n-j) = Σ_i C(j, i) (-1)^i ∇^i l and r_j = Σ_i C(j, i) s^i ∇^i l; mirrored where
    the right one is shorter. Only rounded: joints of other ratios, and degrees below 2 order + 1, at which
    the points of both ends of a piece are the same.
    """
    step = 2 * np.spacing(max(float(np.max(np.abs(piece))) for piece in pieces))  # twice: room for a carry
    exact = [piece / step for piece in pieces]
    rounded = [np.rint(piece) for piece in exact]
    for joint, (h, k) in enumerate(pairwise(durations)):
        ratio = max(h, k) / min(h, k)
        whole = round(ratio)
        left, right = rounded[joint][::-1], rounded[joint + 1]  # both from the joint on
        enough = min(len(left), len(right)) >= 2 * (order + 1)
        if enough and whole <= MOST_RATIO and abs(ratio - whole) <= SAME_RATIO * ratio:
            if h <= k:
                _join(left, right, _differ(exact[joint][::-1], order), whole)
            else:
                _join(right, left, _differ(exact[joint + 1], order), whole)
    return [np.asarray(piece * step, dtype=float) for piece in rounded]


def _differ(points: Wide, order: int) -> list[Wide]:
    """Their first differences, from the 0-th on, as whole numbers."""
    return [np.rint(np.diff(points[: i + 1], n=i, axis=0)[0]) for i in range(order + 1)]


def _join(short: Wide, long: Wide, differences: Sequence[Wide], ratio: int) -> None:
    """Set the first points of both from the differences of one; they go from their joint in opposite ways."""
    for j in range(len(differences)):
        short[j] = sum(comb(j, i) * differences[i] for i in range(j + 1))
        long[j] = sum(comb(j, i) * (-ratio) ** i * differences[i] for i in range(j + 1))
