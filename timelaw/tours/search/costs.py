"""What legs cost, asked for as it is needed: no search of many nodes holds all costs at once."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array

BLOCK = 256  # rows that are sorted at a time

Indices = NDArray[np.intp]
Leg = Callable[[int, int], float]


class Costs(Protocol):
    """Symmetric costs of the legs between N nodes."""

    def __len__(self) -> int:
        """The number of nodes."""

    @property
    def largest(self) -> float:
        """No leg costs more."""

    def row(self, node: int) -> Array:
        """Costs (N,) of the legs from a node; what stands in its own place means nothing."""

    def legs(self, origins: Indices, targets: Indices) -> Array:
        """Costs (M,) of legs between nodes (M,)."""

    def price(self, prices: Array) -> Leg:
        """The cost of one leg and the prices (N,) of the nodes at both its ends, as a function of these."""

    def nearest(self, count: int) -> Indices:
        """The nodes (N, count) at the cheapest legs from each, `count` < N."""


@dataclass(frozen=True)
class CostMatrix:
    """Costs (N, N) that are known all."""

    costs: Array

    def __len__(self) -> int:
        return len(self.costs)

    @cached_property
    def largest(self) -> float:
        """The largest entry."""
        return float(np.max(self.costs))

    def row(self, node: int) -> Array:
        """One row."""
        return np.asarray(self.costs[node])

    def legs(self, origins: Indices, targets: Indices) -> Array:
        """Some entries."""
        return np.asarray(self.costs[origins, targets])

    def price(self, prices: Array) -> Leg:
        """Reads a view, which gives Python's own numbers."""
        costs: Any = self.costs.data
        of = prices.tolist()
        return lambda i, j: costs[i, j] + of[i] + of[j]

    def nearest(self, count: int) -> Indices:
        """By sorting the rows; of equal ones those of smaller numbers."""
        found = []
        for first in range(0, len(self), BLOCK):
            rows = self.costs[first : first + BLOCK].copy()
            np.fill_diagonal(rows[:, first:], np.inf)
            found.append(np.argsort(rows, axis=1, kind="stable")[:, :count])
        return np.concatenate(found)


@dataclass(frozen=True)
class GatedCosts:
    """Costs of closed tours that are open ones of `inner` through a further node, the last: the gate.

    A leg to the gate costs nothing from where an open tour may begin or end: anywhere, or only at the
    nodes `given`, the others at a cost that no tour pays twice.
    """

    inner: Costs
    given: tuple[int, ...]

    def __len__(self) -> int:
        return len(self.inner) + 1

    @property
    def largest(self) -> float:
        """A leg's or a toll."""
        return max(self.inner.largest, float(np.max(self.tolls)))

    @cached_property
    def tolls(self) -> Array:
        """Costs (N,) of the legs to the gate, and of that to itself."""
        tolls = np.zeros(len(self))
        if self.given:
            tolls[:-1] = len(self) * self.inner.largest
            tolls[list(self.given)] = 0.0
        return tolls

    def row(self, node: int) -> Array:
        """One row, the toll at its end."""
        if node == len(self.inner):
            return self.tolls
        return np.append(self.inner.row(node), self.tolls[node])

    def legs(self, origins: Indices, targets: Indices) -> Array:
        """Costs of legs, and tolls."""
        gate = len(self.inner)
        through = (origins == gate) | (targets == gate)
        costs = self.tolls[np.minimum(origins, targets)]
        costs[~through] = self.inner.legs(origins[~through], targets[~through])
        return costs

    def price(self, prices: Array) -> Leg:
        """The inner cost, or a toll."""
        gate, leg = len(self.inner), self.inner.price(prices[:-1])
        tolls, of = self.tolls.tolist(), prices.tolist()

        def price(i: int, j: int) -> float:
            if i == gate or j == gate:
                return float(tolls[i] + tolls[j] + of[i] + of[j])
            return leg(i, j)

        return price

    def nearest(self, count: int) -> Indices:
        """The gate is one of the nearest to each; its own are those that it costs least to leave by."""
        found = np.full((len(self), count), len(self.inner), dtype=np.intp)
        found[:-1, :-1] = self.inner.nearest(count - 1)
        found[-1] = np.argsort(self.tolls[:-1], kind="stable")[:count]
        return found
