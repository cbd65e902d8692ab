"""One step of the search: all rows to first order, as second-order cones, in a trust region."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from timelaw.numerics.array import Array
from timelaw.through.columns import Columns, Index
from timelaw.through.cones import HEAD, solve_cones
from timelaw.through.curve import Curve
from timelaw.through.rows import Rows

NOTHING = 1e-12  # a scaled slope that is rounding
Entries = tuple[Index, Index, Array]


@dataclass(frozen=True)
class Step:
    """The change of the variables (count,), and the slacks that were needed."""

    change: Array
    slacks: Array


@dataclass(frozen=True)
class Aim:
    """What a step makes less: cost · x + ½ |residuals + slopes x|², and times that it keeps.

    `residual` (m,) with its `slope` (m, count) sparse; `kept` (e, count) sparse: sums of variables that stay.
    A cost within `gap` of the least is close enough. `soft` are kinds of rows that may be broken at a price:
    by a slack of each leg, or with `shared` by one for all, which may be negative too.
    """

    cost: Array
    residual: Array = field(default_factory=lambda: np.zeros(0))
    slope: sparse.csr_matrix | None = None
    kept: sparse.csr_matrix | None = None
    soft: NDArray[np.bool_] | None = None  # (n,) of rows
    price: float | Array = 0.0
    shared: bool = False
    gap: float | None = None


def solve_step(
    curve: Curve, columns: Columns, rows: Rows, scales: Array, radius: float, aim: Aim
) -> Step | None:
    """The step that does best; None where nothing near enough holds the rows."""
    slacks = 0 if aim.soft is None else (1 if aim.shared else len(curve.duration))
    count = columns.count + slacks
    matrix, right, count_of = _constraints(rows, columns, slacks, scales, curve, aim)
    down, up = columns.bounds(curve, radius)
    box = sparse.eye(columns.count, count, format="csc")
    blocks: list[Any] = [box, -box]
    sides = [up, down]
    positive, zero = 2 * columns.count, 0
    if slacks and not aim.shared:
        blocks.append(-sparse.eye(slacks, count, k=columns.count, format="csc"))
        sides.append(np.zeros(slacks))
        positive += slacks
    scaling = sparse.diags(np.append(scales, np.ones(slacks)))
    if aim.kept is not None and aim.kept.shape[0]:
        blocks.append(_widen(aim.kept, slacks) @ scaling)
        sides.append(np.zeros(aim.kept.shape[0]))
        zero = aim.kept.shape[0]
    cost = np.append(aim.cost, np.broadcast_to(aim.price, slacks)) * np.append(scales, np.ones(slacks))
    square = sparse.csc_matrix((count, count))
    if aim.slope is not None:
        slope = _widen(aim.slope, slacks) @ scaling
        square = sparse.triu(slope.T @ slope, format="csc")
        cost = cost + slope.T @ aim.residual
    norms, last = count_of
    found = solve_cones(
        cost,
        sparse.vstack([*blocks, matrix], format="csc"),
        np.concatenate([*sides, right]),
        (positive, zero, norms),
        square,
        last,
        aim.gap,
    )
    return None if found is None else Step(found[: columns.count] * scales, found[columns.count :])


def _widen(matrix: sparse.csr_matrix, by: int) -> sparse.csr_matrix:
    return sparse.hstack([matrix, sparse.csr_matrix((matrix.shape[0], by))], format="csr") if by else matrix


def _constraints(
    rows: Rows, columns: Columns, slacks: int, scales: Array, curve: Curve, aim: Aim
) -> tuple[sparse.csc_matrix, Array, tuple[int, int]]:
    """A and b of b - A x: in so many cones, and after them so many rows that are at least zero.

    |value + slope dx| ≤ 1 + k dh/h + slack, or each component so.
    """
    leg = columns.legs[rows.leg]
    free = leg >= 0
    room = np.where(free, rows.power / curve.duration[rows.leg] * scales[np.maximum(leg, 0)], 0.0)
    order = np.argsort(rows.by_axis, kind="stable")  # cones first, then components
    norms = order[~rows.by_axis[order]]
    axes = order[rows.by_axis[order]]

    entries: list[Entries]

    def heads(at: Index, own: Index) -> list[Entries]:
        moved = free[own] & (rows.power[own] > 0)
        found = [(at[moved], leg[own][moved], -room[own][moved])]
        if aim.soft is not None:
            soft = aim.soft[own]
            slack = columns.count + (np.zeros(len(own), dtype=int) if aim.shared else rows.leg[own])
            found.append((at[soft], slack[soft], -np.ones(np.count_nonzero(soft))))
        return found

    first = HEAD * np.arange(len(norms))
    entries = heads(first, norms)
    entries += [_spread(first + 1 + i, rows, norms, i, -1.0, scales) for i in range(3)]
    start = HEAD * len(norms)
    for i in range(3):
        for sign in (1.0, -1.0):
            own = start + np.arange(len(axes))
            entries += [*heads(own, axes), _spread(own, rows, axes, i, sign, scales)]
            start += len(axes)
    at, where, value = (np.concatenate(part) for part in zip(*entries, strict=True))
    shape = (start, columns.count + slacks)
    matrix = sparse.csc_matrix((value, (at.astype(int), where.astype(int))), shape=shape)
    tops = np.concatenate([np.ones((len(norms), 1)), rows.value[norms]], axis=1).ravel()
    sides = [1 - sign * rows.value[axes, i] for i in range(3) for sign in (1.0, -1.0)]
    return matrix, np.concatenate([tops, *sides]), (len(norms), 6 * len(axes))


def _spread(at: Index, rows: Rows, own: Index, axis: int, sign: float, scales: Array) -> Entries:
    """Entries of one component's slopes, those of fixed columns left out."""
    columns = rows.columns[own]
    value = sign * rows.slope[own, axis] * scales[np.maximum(columns, 0)]
    free = (columns >= 0) & (np.abs(value) > NOTHING)
    return np.broadcast_to(at[:, None], columns.shape)[free], columns[free], np.asarray(value[free])
