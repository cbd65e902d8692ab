"""Remez's one-point exchange on the least times of many legs at once.

Wanted is the least T with |f^(k)(τ)| ≤ w_k T^k for all τ and k, where f = e_0 + Σ x_i e_i. For a given T each
point is a linear row, s f^(k)(τ) ≤ w_k T^k with s = ±1. A reference is n + 1 rows with multipliers λ ≥ 0 in
which x cancels: Σ λ s e_i^(k)(τ) = 0 for i > 0. Then no law is faster than Σ λ s e_0^(k)(τ) = Σ λ w_k T^k
says, and one x makes equalities of all n + 1. The row that this x breaks most comes in, and that one goes
which keeps the multipliers positive: the bound on T rises. Where no row is broken, it is the least time.
It is the dual simplex method on a semi-infinite program [R1934].
"""

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array
from timelaw.single_legs.extrema_on_legs import Broken, find_broken
from timelaw.single_legs.symmetric_easings import SymmetricEasings

TOLERANCE = 1e-9  # relative, in time: by so much a limit is still broken at the end
MOST_EXCHANGES = 60  # for each row of a reference; a few are usual
BALANCES = 8  # Newton's steps to the time of a reference, each about squares the error
TINY = 1e-300  # a multiplier that is zero


@dataclass(frozen=True)
class References:
    """Of each of m legs n + 1 rows: the orders k (m, n+1), and s e_i^(k)(τ) (m, n+1, n+1), i last."""

    orders: Array
    rows: Array

    def take(self, legs: NDArray[Any]) -> "References":
        """Those of some legs, by number or mask."""
        return References(self.orders[legs], self.rows[legs])

    def copy(self) -> "References":
        """Others that are equal."""
        return References(self.orders.copy(), self.rows.copy())


@dataclass(frozen=True)
class LeastTimes:
    """Of each leg x (m, n), what T is at least [s] (m,), and how many rows came in (m,).

    Not finite where rounding ended the search.
    """

    chosen: Array
    bound: Array
    exchanges: Array


def find_least_times(easings: SymmetricEasings, bounds: Array) -> LeastTimes:
    """The easings with |f^(k)| ≤ `bounds` (m, K) T^k, k from 1, inf for none, that take least time."""
    powers = np.arange(1, bounds.shape[1] + 1)
    unit = np.max(bounds ** (-1 / powers), axis=1)
    shares = 1 / (bounds * unit[:, None] ** powers)  # of the limits that f^(k) = 1 uses in the unit time
    peaks = np.array([np.max(np.abs(easings.on_grid[k][0])) for k in powers])
    hardest = np.argmax((peaks * shares) ** (1 / powers), axis=1)  # for the smoothstep
    found, _ = _exchange_rows(easings, shares, _list_first_references(easings, len(powers)).take(hardest))
    return replace(found, bound=unit * np.exp(found.bound))


def _exchange_rows(
    easings: SymmetricEasings, shares: Array, references: References
) -> tuple[LeastTimes, References]:
    """Exchange until no limit is broken; log T for T, and the last references."""
    chosen, bound = np.full((len(shares), easings.free), np.nan), np.full(len(shares), np.nan)
    exchanges, last = np.zeros(len(shares), dtype=int), references.copy()
    live, times = np.arange(len(shares)), np.zeros(len(shares))
    for number in range(MOST_EXCHANGES * (easings.free + 1)):
        inverse = _invert(_scale(references, shares[live], times))
        multipliers = inverse[:, -1]
        steps = _balance(references, shares[live], times, multipliers)
        x = _solve_equalities(references, shares[live], times, steps, inverse)
        before, times = times, times + steps
        broken = find_broken(easings, x, shares[live], times)
        done = broken.excess <= TOLERANCE
        chosen[live[done]], bound[live[done]] = x[done], times[done]
        last.orders[live[done]], last.rows[live[done]] = references.orders[done], references.rows[done]
        exchanges[live[done]] = number
        go = ~done & np.isfinite(broken.excess) & np.isfinite(times)
        if not np.any(go):
            break
        broken, live = broken.take(go), live[go]
        leaving = _choose_leaving(broken, shares[live], before[go], multipliers[go], inverse[go])
        references, times = _exchange(references.take(go), leaving, broken), times[go]
    return LeastTimes(chosen, bound, exchanges), last


@cache
def _list_first_references(easings: SymmetricEasings, highest: int) -> References:
    """For each order the last references where only that is limited: most legs are near to one of these."""
    orders = np.repeat(np.arange(1.0, highest + 1)[:, None], easings.free + 1, axis=1)
    rows = np.array([_list_first_rows(easings, k) for k in range(1, highest + 1)])
    return _exchange_rows(easings, np.eye(highest), References(orders, rows))[1]


def _list_first_rows(easings: SymmetricEasings, order: int) -> Array:
    """A reference (n+1, n+1) of one order: any points will do, the signs are those of the multipliers."""
    count = easings.free + 1
    z = -np.cos(np.pi / 2 * (np.arange(count) + 0.5) / count)
    rows = easings.expand(z) @ easings.derivatives[order].T
    null = np.linalg.svd(rows[:, 1:].T)[2][-1]
    signs = np.sign(null) * np.sign(null @ rows[:, 0])
    return np.asarray(rows * signs[:, None])


def _pick(shares: Array, times: Array, orders: Array) -> Array:
    """The part of its limit that f^(k) = 1 uses in these times, by row (m, n+1) or leg (m,)."""
    wide = orders if orders.ndim == 2 else orders[:, None]
    found = np.take_along_axis(shares, wide.astype(int) - 1, axis=1) * np.exp(-wide * times[:, None])
    return np.asarray(found if orders.ndim == 2 else found[:, 0])


def _scale(references: References, shares: Array, times: Array) -> Array:
    """Matrices (m, n+1, n+1) of the equalities in x and log T: what a row gains, in parts of its limit."""
    part = _pick(shares, times, references.orders)
    gains = references.rows[:, :, 1:] * part[..., None]
    return np.concatenate([gains, references.orders[..., None]], axis=2)


def _invert(matrices: Array) -> Array:
    """Inverses; of a singular one the pseudo-inverse, from which its leg gets no further."""
    try:
        return np.asarray(np.linalg.inv(matrices))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(matrices))


def _balance(references: References, shares: Array, times: Array, multipliers: Array) -> Array:
    """How much log T (m,) has to grow until Σ λ (1 - s e_0^(k) / w_k T^k) = 0."""
    part = _pick(shares, times, references.orders)
    wanted = np.sum(multipliers * references.rows[..., 0] * part, axis=1)
    steps = np.zeros(len(times))
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        for _ in range(BALANCES):
            terms = multipliers * np.exp(references.orders * steps[:, None])
            total = np.sum(terms, axis=1)
            steps += np.log(wanted / total) * total / np.sum(terms * references.orders, axis=1)
    return steps


def _solve_equalities(
    references: References, shares: Array, times: Array, steps: Array, inverse: Array
) -> Array:
    """The x (m, n) with which all rows of the reference are equalities."""
    part = _pick(shares, times, references.orders)
    right = np.exp(references.orders * steps[:, None]) - references.rows[..., 0] * part
    return np.asarray((inverse @ right[..., None])[:, :-1, 0])


def _choose_leaving(broken: Broken, shares: Array, times: Array, multipliers: Array, inverse: Array) -> Array:
    """The row (m,) of each reference without which the multipliers stay positive."""
    gains = broken.rows[:, 1:] * _pick(shares, times, broken.orders)[:, None]
    needed = -np.einsum("mi,mij->mj", gains, inverse[:, :-1])
    return np.asarray(np.argmax(-needed / np.maximum(multipliers, TINY), axis=1))


def _exchange(references: References, leaving: Array, broken: Broken) -> References:
    """The references with the broken rows in the places of the leaving ones."""
    exchanged, legs = references.copy(), np.arange(len(leaving))
    exchanged.orders[legs, leaving], exchanged.rows[legs, leaving] = broken.orders, broken.rows
    return exchanged
