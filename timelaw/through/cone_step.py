"""One step of the search: all rows to first order, as second-order cones, in a trust region."""

from dataclasses import dataclass

import clarabel
import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from timelaw.numerics.array import Array
from timelaw.through.columns import Columns, Index
from timelaw.through.curve import Curve
from timelaw.through.rate_limits import ORDERS, RateLimits
from timelaw.through.turning_rows import derive_rates, make_basis

NEAR = 0.75  # used parts below it are no rows, unless the trust region could bring them up
REACH = 1.5  # times the trust region: how far a used part may rise in a step
SOLVED = ("Solved", "AlmostSolved")
HEAD = 4  # rows of a cone: the room, and three components


@dataclass(frozen=True)
class Rows:
    """Rates over bounds at points, to first order: `value` (n, 3), `slope` (n, 3, v) by `columns` (n, v).

    `order` (n,) is the power of the leg's time, `leg` (n,) its variable; `by_axis` says which bounds mean.
    """

    value: Array
    slope: Array
    columns: Index
    order: Index
    leg: Index
    by_axis: NDArray[np.bool_]


def collect_rows(curve: Curve, columns: Columns, limits: RateLimits, used: Array, radius: float) -> Rows:
    """Rows at Chebyshev points and the present maxima of `used` (p, m, 3), where they may come to matter."""
    places = _places(curve.degree, used)
    basis = make_basis(curve.degree, places.ravel()).reshape(*places.shape, 4, curve.degree + 1)
    points = curve.control()
    rates = derive_rates(points, basis)
    states = np.einsum("pmko,pocv->pmkcv", basis, curve.slopes(points), optimize=True)
    slope = np.einsum("pmxykc,pmkcv->pmxyv", rates.slope, states, optimize=True)
    parts = limits.used(rates.value, curve.steps)
    piece, place, k = np.nonzero(parts > min(NEAR, 1 - REACH * radius))
    bounds = np.stack([_bound_of(limits, order) for order in ORDERS])
    scale = bounds[k] * curve.steps[piece, None] ** (k + 1)[:, None]
    by_axis = np.array([order in limits.bounds and limits.bounds[order].ndim > 0 for order in ORDERS])
    return Rows(
        rates.value[piece, place, k] / scale,
        slope[piece, place, k] / scale[:, :, None],
        columns.of_pieces[piece],
        k + 1,
        np.repeat(columns.legs, curve.pieces)[piece],
        by_axis[k],
    )


def _bound_of(limits: RateLimits, order: int) -> Array:
    return np.broadcast_to(limits.bounds.get(order, np.array(np.inf)), 3)


def _places(degree: int, used: Array) -> Array:
    """(p, m): Chebyshev points, and the local maxima of the largest used part on its grid."""
    count = 2 * degree
    fixed = (1 - np.cos(np.pi * np.arange(count + 1) / count)) / 2
    worst = np.max(used, axis=2)
    padded = np.pad(worst, ((0, 0), (1, 1)), constant_values=-1.0)
    tops = (worst >= padded[:, :-2]) & (worst >= padded[:, 2:])
    most = int(np.max(np.sum(tops, axis=1)))
    order = np.argsort(~tops, axis=1, kind="stable")[:, :most]
    grid = np.linspace(0.0, 1.0, used.shape[1])
    own = np.where(np.take_along_axis(tops, order, axis=1), grid[order], 0.5)
    return np.hstack([np.broadcast_to(fixed, (len(used), count + 1)), own])


def solve_step(curve: Curve, columns: Columns, rows: Rows, scales: Array, radius: float) -> Array | None:
    """The step (count,) that makes the time least; None where nothing near enough holds the rows."""
    matrix, right, cones = _constraints(rows, columns.count, scales, curve, columns)
    down, up = columns.bounds(curve, radius)
    identity = sparse.identity(columns.count, format="csc")
    cost = np.zeros(columns.count)
    cost[columns.legs] = scales[columns.legs] / np.mean(scales[columns.legs])
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1  # last digits must not depend on how many there are
    solver = clarabel.DefaultSolver(
        sparse.csc_matrix((columns.count, columns.count)),
        cost,
        sparse.vstack([identity, -identity, matrix], format="csc"),
        np.concatenate([up, down, right]),
        [clarabel.NonnegativeConeT(2 * columns.count), *cones],
        settings,
    )
    solution = solver.solve()
    return np.array(solution.x) * scales if str(solution.status) in SOLVED else None


def _constraints(
    rows: Rows, count: int, scales: Array, curve: Curve, columns: Columns
) -> tuple[sparse.csc_matrix, Array, list[object]]:
    """A and b of b - A x in the cones: |value + slope dx| ≤ 1 + k dh/h, or each component so."""
    steps = np.ones(count)
    steps[columns.legs] = curve.duration
    room = rows.order / steps[rows.leg] * scales[rows.leg]
    order = np.argsort(rows.by_axis, kind="stable")  # cones first, then components
    norms = order[~rows.by_axis[order]]
    axes = order[rows.by_axis[order]]
    first = HEAD * np.arange(len(norms))
    entries = [(first, rows.leg[norms], -room[norms])]
    entries += [_spread(first + 1 + i, rows, norms, i, -1.0, scales) for i in range(3)]
    start = HEAD * len(norms)
    for i in range(3):
        for sign in (1.0, -1.0):
            own = start + np.arange(len(axes))
            entries += [(own, rows.leg[axes], -room[axes]), _spread(own, rows, axes, i, sign, scales)]
            start += len(axes)
    at, where, value = (np.concatenate(part) for part in zip(*entries, strict=True))
    matrix = sparse.csc_matrix((value, (at.astype(int), where.astype(int))), shape=(start, count))
    heads = np.concatenate([np.ones((len(norms), 1)), rows.value[norms]], axis=1).ravel()
    sides = [1 - sign * rows.value[axes, i] for i in range(3) for sign in (1.0, -1.0)]
    cones: list[object] = [clarabel.SecondOrderConeT(HEAD)] * len(norms)
    if len(axes):
        cones.append(clarabel.NonnegativeConeT(6 * len(axes)))
    return matrix, np.concatenate([heads, *sides]), cones


def _spread(
    at: Index, rows: Rows, own: Index, axis: int, sign: float, scales: Array
) -> tuple[Index, Index, Array]:
    """Entries of one component's slopes, those of fixed columns left out."""
    columns = rows.columns[own]
    free = columns >= 0
    value = sign * rows.slope[own, axis] * scales[np.maximum(columns, 0)]
    return np.broadcast_to(at[:, None], columns.shape)[free], columns[free], np.asarray(value[free])
