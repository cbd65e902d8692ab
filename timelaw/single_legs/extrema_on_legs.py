"""The point at which each of many easings breaks its limits most."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array
from timelaw.single_legs.symmetric_easings import SymmetricEasings

Indices = NDArray[np.int64]

NEAR = 0.03  # relative: by so much an extremum may look smaller on the grid
STEPS = 4  # of Newton's method from the grid to an extremum


@dataclass(frozen=True)
class Broken:
    """Of each leg the order k (m,) of a row, s e_i^(k)(τ) (m, n+1), and by how much it breaks log T (m,)."""

    orders: Array
    rows: Array
    excess: Array

    def take(self, legs: NDArray[np.bool_]) -> "Broken":
        """Those of some legs."""
        return Broken(self.orders[legs], self.rows[legs], self.excess[legs])


def find_broken(easings: SymmetricEasings, chosen: Array, shares: Array, times: Array) -> Broken:
    """The row that x (m, n) breaks most in the times log T (m,); f^(k) = 1 uses `shares` (m, K) at T = 1."""
    weights = np.concatenate([np.ones((len(chosen), 1)), chosen], axis=1)
    count = len(weights)
    most = Broken(np.zeros(count), np.zeros_like(weights), np.full(count, -np.inf))
    for order in range(1, shares.shape[1] + 1):
        if not np.any(shares[:, order - 1]):
            continue
        leg, place = _list_tops(np.abs(weights @ easings.on_grid[order]))
        rows = easings.expand(_climb(easings, weights, order, leg, place)) @ easings.derivatives[order].T
        values = np.sum(rows * weights[leg], axis=1)
        with np.errstate(divide="ignore"):
            excess = np.log(np.abs(values) * shares[leg, order - 1]) / order - times[leg]
        rising = np.argsort(excess, kind="stable")  # of each leg the largest is written last
        top = np.zeros(count, dtype=np.int64)
        top[leg[rising]] = rising
        better = excess[top] > most.excess
        top = top[better]
        most.orders[better], most.excess[better] = order, excess[top]
        most.rows[better] = rows[top] * np.sign(values[top])[:, None]
    return most


def _list_tops(sizes: Array) -> tuple[Indices, Indices]:
    """Legs and places on the grid of the local maxima (m, points) that may be the largest of the leg."""
    padded = np.pad(sizes, ((0, 0), (1, 1)), constant_values=-1.0)
    high = sizes >= np.max(sizes, axis=1, keepdims=True) * (1 - NEAR)
    legs, places = np.nonzero(high & (sizes >= padded[:, :-2]) & (sizes > padded[:, 2:]))
    return legs, places


def _climb(easings: SymmetricEasings, weights: Array, order: int, leg: Indices, place: Indices) -> Array:
    """From places on the grid to where |f^(k)| is greatest beside them, as z."""
    grid, last = easings.grid, len(easings.grid) - 1
    low, high = grid[np.maximum(place - 1, 0)], grid[np.minimum(place + 1, last)]
    rates, slopes, bends = ((weights @ easings.derivatives[order + more])[leg] for more in range(3))
    best = grid[place]
    size = np.abs(np.sum(easings.expand(best) * rates, axis=1))
    # in the middle of the leg the slope is zero, whether that is a top or a hollow between two
    z = np.where(place == last, (low + high) / 2, best)
    for _ in range(STEPS):
        powers = easings.expand(z)
        slope, bend = np.sum(powers * slopes, axis=1), np.sum(powers * bends, axis=1)
        step = np.divide(2 * slope, bend, out=np.zeros_like(z), where=bend != 0)  # τ = (1 + z)/2
        z = np.clip(z - step, low, high)
        now = np.abs(np.sum(easings.expand(z) * rates, axis=1))
        best, size = np.where(now > size, z, best), np.maximum(now, size)
    return np.asarray(best)
