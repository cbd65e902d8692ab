"""Rows and efforts at points of legs, sorted into blocks of points that share kernel and variables."""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from timelaw.nlp.assembly import Block, Indices
from timelaw.nlp.kernel import End, Kernel
from timelaw.nlp.monomials import Exponents
from timelaw.nlp.variables import LegEnd, LegVariables
from timelaw.numerics.array import Array

Arrays = tuple[Indices, Array, Array, Array]  # variables, parameters and bounds of some members
SPARSE = 1e-15  # of the largest entry of a column; rows are checked on the law itself afterwards


class Form(NamedTuple):
    """A polynomial in rates, but for its coefficients; see `Kernel`."""

    orders: tuple[int, ...]
    exponents: tuple[Exponents, ...]
    lasting: int = 0
    root: int = 0


class PointRows(NamedTuple):
    """A polynomial in rates at points τ (m,) of a leg: coefficients (m, terms), and its bounds (m,)."""

    leg: LegVariables
    form: Form
    tau: Array
    coefficients: Array
    lower: Array
    upper: Array


class Rows(NamedTuple):
    """A block with the parameters of its points (points, p) and their bounds (points,)."""

    block: Block
    parameters: Array
    lower: Array
    upper: Array


def sort_rows(found: Sequence[PointRows], peak: int) -> list[Rows]:
    """All rows in blocks; `peak` is the place of the used part of the limits among the variables."""
    alike: dict[tuple[object, ...], list[PointRows]] = defaultdict(list)
    for rows in found:
        if len(rows.tau):
            leg = rows.leg
            ends = (_kind(leg.left, leg.continuity), _kind(leg.right, leg.continuity))
            alike[leg.basis, rows.form, ends].append(rows)
    by_kernel: dict[tuple[Kernel, int], list[Arrays]] = defaultdict(list)
    for group in alike.values():
        for kernel, points, arrays in _sort_alike(group, peak):
            by_kernel[kernel, points].append(arrays)
    joined = []
    for (kernel, points), parts in by_kernel.items():
        variables, parameters, lower, upper = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
        block = Block(kernel, points, tuple(variables.ravel().tolist()))
        joined.append(Rows(block, parameters, lower, upper))
    return joined


def _kind(end: LegEnd, continuity: int) -> End:
    if end.first is None:
        return End(continuity if end.given else 0)
    return End(continuity, shared=True)


def _sort_alike(group: Sequence[PointRows], peak: int) -> Iterator[tuple[Kernel, int, Arrays]]:
    """Rows of one form on legs of one basis: kernel, points of each member, variables, parameters, bounds."""
    leg, form = group[0].leg, group[0].form
    tau = np.concatenate([rows.tau for rows in group])
    owner = np.repeat(np.arange(len(group)), [len(rows.tau) for rows in group])
    coefficients = np.concatenate([rows.coefficients for rows in group])
    bounds = [np.concatenate([getattr(rows, side) for rows in group]) for side in ("lower", "upper")]
    kinds = [_kind(leg.left, leg.continuity), _kind(leg.right, leg.continuity)]
    parts = [_scale_parts(group, owner, *part) for part in _rate_parts(leg, form, tau, kinds)]
    reach = [np.any([part[i] != 0 for part in parts], axis=0) for i in range(1, 4)]  # in any order
    window, free = _find_windows(reach[0])
    pattern = reach[1].any(axis=1) + 2 * reach[2].any(axis=1)
    key = np.stack([pattern, owner, window])
    order = np.lexsort(key[::-1])
    key = key[:, order]
    starts = np.flatnonzero(np.concatenate([[True], np.any(key[:, 1:] != key[:, :-1], axis=0)]))
    counts = np.diff([*starts, key.shape[1]])
    for which, points in sorted(set(zip(key[0, starts].tolist(), counts.tolist(), strict=True))):
        members = starts[(key[0, starts] == which) & (counts == points)]
        at = order[(members[:, None] + np.arange(points)).ravel()]
        left, right = (kind if which & bit else End() for kind, bit in zip(kinds, (1, 2), strict=True))
        kernel = Kernel(form.orders, form.exponents, free, left, right, form.lasting, form.root)
        legs = [group[i].leg for i in key[1, members].tolist()]
        variables = _list_variables(kernel, legs, key[2, members], peak)
        columns = [
            column
            for part in parts
            for column in (
                part[0][at],
                np.take_along_axis(part[1][at], window[at, None] + np.arange(free), axis=1),
                part[2][at, : left.rates],
                part[3][at, : right.rates],
            )
        ]
        parameters = np.hstack([*columns, coefficients[at]])
        yield kernel, points, (variables, parameters, bounds[0][at], bounds[1][at])


def _rate_parts(
    leg: LegVariables, form: Form, tau: Array, kinds: Sequence[End]
) -> Iterator[tuple[int, Array, Array, Array, Array]]:
    """For each order that of the rate, and matrices (m, …) of what is constant, coefficients, left, right."""
    unique, inverse = np.unique(tau, return_inverse=True)
    for order in form.orders:
        values = leg.basis.values(unique, order)
        ends = (_drop_rounding(values @ leg.basis.from_left), _drop_rounding(values @ leg.basis.from_right))
        free = _drop_rounding(values @ leg.basis.from_free)
        left, right = (end[:, 1 : 1 + kind.rates] for end, kind in zip(ends, kinds, strict=True))
        yield order, ends[1][inverse, :1], free[inverse], left[inverse], right[inverse]


def _scale_parts(
    group: Sequence[PointRows],
    owner: Indices,
    order: int,
    constant: Array,
    free: Array,
    left: Array,
    right: Array,
) -> tuple[Array, Array, Array, Array]:
    """The same in rad/s^k of each leg, ends given times what they are."""
    legs = [rows.leg for rows in group]
    size = np.array([leg.demand.angle / leg.unit**order for leg in legs])[owner, None]
    powers = np.arange(1, legs[0].continuity + 1)
    rates = np.array([leg.rate * leg.pace**powers for leg in legs])
    ends = []
    for part, own in ((left, [leg.left for leg in legs]), (right, [leg.right for leg in legs])):
        given = np.array([end.given or np.ones(len(powers)) for end in own])
        ends.append(size * part * (rates * given)[owner, : part.shape[1]])
    return size * constant, size * free, ends[0], ends[1]


def _drop_rounding(matrix: Array) -> Array:
    rounding = SPARSE * np.max(np.abs(matrix), axis=0, initial=0.0)
    return np.where(np.abs(matrix) > rounding, matrix, 0.0)


def _find_windows(reach: Array) -> tuple[Indices, int]:
    """The first coefficient (m,) of those in a row that reach each point, and how many these are at most."""
    count = reach.shape[1]
    if not count or not reach.any():
        return np.zeros(len(reach), dtype=np.int64), 0
    first = np.where(reach.any(axis=1), np.argmax(reach, axis=1), 0)
    last = np.where(reach.any(axis=1), count - 1 - np.argmax(reach[:, ::-1], axis=1), 0)
    width = int(np.max(last - first)) + 1
    return np.minimum(first, count - width), width


def _list_variables(kernel: Kernel, legs: Sequence[LegVariables], windows: Indices, peak: int) -> Indices:
    """The variables (members, z) of the kernel at members on these legs."""
    columns = [
        np.array([leg.place for leg in legs])[:, None],
        (np.array([leg.free for leg in legs]) + windows)[:, None] + np.arange(kernel.free),
    ]
    for end, own in (
        (kernel.left, [leg.left for leg in legs]),
        (kernel.right, [leg.right for leg in legs]),
    ):
        if end.variables:
            columns.append(np.array([place.first for place in own])[:, None] + np.arange(end.rates))
    if kernel.root:
        columns.append(np.full((len(legs), 1), peak))
    return np.hstack(columns)
