"""Cone programs, handed to Clarabel the same way by every search."""

from collections.abc import Sequence

import clarabel
import numpy as np
from scipy import sparse

from timelaw.numerics.array import Array
from timelaw.progress import count_steps

SOLVED = ("Solved", "AlmostSolved")
NONE = ("PrimalInfeasible", "AlmostPrimalInfeasible")
HEAD = 4  # rows of a second-order cone: the room, and three components
FEASIBLE = 1e-6  # of scaled rows, where `gap` says how exact is exact enough


def solve_cones(
    cost: Array,
    matrix: sparse.csc_matrix,
    right: Array,
    sizes: tuple[int, int, int],
    square: sparse.csc_matrix | None = None,
    last: int = 0,
    gap: float | None = None,
) -> Array | None:
    """The x (n,) that makes cost · x + ½ x · square x least, b - A x in the cones; None if none is found.

    In their order: `sizes` are how many rows of A are at least zero, how many are zero, and how many cones of
    four rows there are; `last` rows are at least zero again. With a `gap` of the cost that is close enough,
    of a program whose rows and variables are of the size of one, half the work is saved.
    """
    positive, zero, count = sizes
    cones: Sequence[object] = [
        clarabel.NonnegativeConeT(positive),
        *([clarabel.ZeroConeT(zero)] if zero else []),
        *[clarabel.SecondOrderConeT(HEAD)] * count,
        *([clarabel.NonnegativeConeT(last)] if last else []),
    ]
    program = (sparse.csc_matrix((len(cost), len(cost))) if square is None else square, cost, matrix, right)
    for settings in (_settings(),) if gap is None else (_settings(gap), _settings()):
        solution = clarabel.DefaultSolver(*program, list(cones), settings).solve()
        count_steps(int(solution.iterations))
        if str(solution.status) in SOLVED:
            return np.array(solution.x)
        if str(solution.status) in NONE:
            break
    return None


def _settings(gap: float | None = None) -> clarabel.DefaultSettings:
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1  # last digits must not depend on how many there are
    if gap is not None:
        settings.tol_gap_abs, settings.tol_feas = gap, FEASIBLE
        settings.equilibrate_enable = settings.iterative_refinement_enable = False
    return settings
