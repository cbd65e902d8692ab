"""Cone programs, handed to Clarabel the same way by every search."""

from collections.abc import Sequence

import clarabel
import numpy as np
from scipy import sparse

from timelaw.numerics.array import Array

SOLVED = ("Solved", "AlmostSolved")
HEAD = 4  # rows of a second-order cone: the room, and three components


def solve_cones(
    cost: Array,
    matrix: sparse.csc_matrix,
    right: Array,
    sizes: tuple[int, int, int],
    square: sparse.csc_matrix | None = None,
    last: int = 0,
) -> Array | None:
    """The x (n,) that makes cost · x + ½ x · square x least, b - A x in the cones; None if none is found.

    In their order: `sizes` are how many rows of A are at least zero, how many are zero, and how many cones of
    four rows there are; `last` rows are at least zero again.
    """
    positive, zero, count = sizes
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1  # last digits must not depend on how many there are
    cones: Sequence[object] = [
        clarabel.NonnegativeConeT(positive),
        *([clarabel.ZeroConeT(zero)] if zero else []),
        *[clarabel.SecondOrderConeT(HEAD)] * count,
        *([clarabel.NonnegativeConeT(last)] if last else []),
    ]
    empty = sparse.csc_matrix((len(cost), len(cost)))
    solver = clarabel.DefaultSolver(
        empty if square is None else square, cost, matrix, right, list(cones), settings
    )
    solution = solver.solve()
    return np.array(solution.x) if str(solution.status) in SOLVED else None
