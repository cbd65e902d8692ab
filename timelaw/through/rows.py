"""Rows of a step of the search: what is held down to first order, where it may come to matter."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.limits.formula import Vector
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import basis_matrix
from timelaw.through.columns import Columns, Index
from timelaw.through.curve import Curve
from timelaw.through.dual import seed, stack, stack_slopes
from timelaw.through.kinematics import list_rates
from timelaw.through.measures import Measure, find_highest, find_tops

NEAR = 0.75  # used parts below it are no rows, unless the trust region could bring them up
BLOCK = 4096  # places that are looked at together, so that memory stays small
REACH = 1.5  # times the trust region: how far a used part may rise in a step


@dataclass(frozen=True)
class Rows:
    """Vectors over their bounds, to first order: `value` (n, 3), `slope` (n, 3, v) by `columns` (n, v).

    `power` (n,) is that of time in them; they are of pieces of `leg` (n,). `by_axis` (n,) says whether each
    component is bounded, or the norm.
    """

    value: Array
    slope: Array
    columns: Index
    power: Index
    leg: Index
    by_axis: NDArray[np.bool_]


@dataclass(frozen=True)
class Places:
    """Places on pieces (n,), a curve's states there (n, o, 4), and their slopes (n, o, 4, v)."""

    piece: Index
    values: Array
    slopes: Array


def look_at(curve: Curve, slopes: Array, piece: Index, at: Array, highest: int) -> Places:
    """A curve's states at places of its pieces; `slopes` (Kp, d+1, 4, v) are those of its control points."""
    basis = np.stack([basis_matrix(curve.degree, at, k) for k in range(highest + 1)], axis=1)
    points = curve.control()
    values = np.einsum("noi,nic->noc", basis, points[piece])
    found = np.empty((len(piece), highest + 1, *slopes.shape[2:]))
    for start in range(0, len(piece), BLOCK):
        own = slice(start, start + BLOCK)
        found[own] = np.einsum("noi,nicv->nocv", basis[own], slopes[piece[own]], optimize=True)
    return Places(piece, values, found)


def collect_rows(
    curve: Curve, columns: Columns, measures: Sequence[Measure], used: Array, radius: float
) -> Rows:
    """Rows at Chebyshev points and the present maxima of `used` (p, m, L)."""
    highest = find_highest(measures)
    places = _places(curve.degree, used)
    grid = used.shape[1] - 1
    index = np.clip(places * grid, 0, grid)
    left = np.floor(index).astype(int)
    piece = np.arange(len(used))[:, None]
    near = np.maximum(used[piece, left], used[piece, np.minimum(left + 1, grid)])
    wanted = near > min(NEAR, 1 - REACH * radius)
    owner, place = np.nonzero(np.any(wanted, axis=2))
    wanted = wanted[owner, place]
    slopes = columns.by_clock(curve, curve.slopes())
    seen = look_at(curve, slopes, owner, places[owner, place], highest)
    return join_rows(
        [
            _derive(curve, columns, measure, seen, np.nonzero(wanted[:, k])[0])
            for k, measure in enumerate(measures)
        ]
    )


def join_rows(parts: Sequence[Rows]) -> Rows:
    """All of them."""
    names = ("value", "slope", "columns", "power", "leg", "by_axis")
    return Rows(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def derive_vector(curve: Curve, measure: Measure, seen: Places, own: Index) -> tuple[Array, Array, Array]:
    """V (n, 3) at the places `own`, its slopes (n, 3, v) by the variables of pieces, and ∂V/∂h (n, 3)."""
    orders = measure.highest + 1
    count = 4 * orders + 1
    states: list[Vector] = [seed(seen.values[own, k], 4 * k, count) for k in range(orders)]
    step = seed(curve.steps[seen.piece[own], None], count - 1, count)[0]
    legs = seen.piece[own] // curve.pieces
    rates = list_rates(states) if orders > 1 else {}
    vector = list(measure.vector(states, rates, step, legs))
    slopes = stack_slopes(vector, step)
    by_states = slopes[..., :-1].reshape(len(own), 3, orders, 4)
    chained = np.einsum("nxkc,nkcv->nxv", by_states, seen.slopes[own, :orders], optimize=True)
    return stack(vector), chained, slopes[..., -1]


def _derive(curve: Curve, columns: Columns, measure: Measure, seen: Places, own: Index) -> Rows:
    legs = seen.piece[own] // curve.pieces
    bounds = measure.bounds[legs]
    own, bounds = own[np.any(np.isfinite(bounds), axis=1)], bounds[np.any(np.isfinite(bounds), axis=1)]
    legs = seen.piece[own] // curve.pieces
    value, slope, by_step = derive_vector(curve, measure, seen, own)
    knot, _ = curve.columns
    slope[..., 2 * knot] += by_step
    scale = bounds * curve.steps[seen.piece[own], None] ** measure.power
    return Rows(
        value / scale,
        slope / scale[:, :, None],
        columns.of_pieces[seen.piece[own]],
        np.full(len(own), measure.power),
        legs,
        np.full(len(own), bounds.shape[1] == 3),
    )


def _places(degree: int, used: Array) -> Array:
    """(p, m): Chebyshev points, and the local maxima of the largest used part on its grid."""
    count = 2 * degree
    fixed = (1 - np.cos(np.pi * np.arange(count + 1) / count)) / 2
    shift, tops = find_tops(used)
    first = np.argmax(tops, axis=2)[..., None]
    worst = np.take_along_axis(tops, first, axis=2)[..., 0]
    aside = np.take_along_axis(shift, first, axis=2)[..., 0]
    padded = np.pad(worst, ((0, 0), (1, 1)), constant_values=-1.0)
    highest = (worst >= padded[:, :-2]) & (worst >= padded[:, 2:])
    most = int(np.max(np.sum(highest, axis=1)))
    order = np.argsort(~highest, axis=1, kind="stable")[:, :most]
    step = 1 / (used.shape[1] - 1)
    at = np.clip((order + np.take_along_axis(aside, order, axis=1)) * step, 0.0, 1.0)
    own = np.where(np.take_along_axis(highest, order, axis=1), at, 0.5)
    return np.hstack([np.broadcast_to(fixed, (len(used), count + 1)), own])
