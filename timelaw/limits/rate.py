"""Limits on angular velocity, acceleration, jerk and snap: one class with an order."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from timelaw.limits.bounds import Bounds, bound_vector, least_quotient, split_by_axis
from timelaw.limits.formula import ZERO, Formula, Rates, Vector
from timelaw.limits.row import RateRow
from timelaw.numerics.array import Array

UNITS = {1: "rad/s", 2: "rad/s²", 3: "rad/s³", 4: "rad/s⁴"}


@dataclass(frozen=True)
class Rate:
    """|ω^(k-1)| ≤ w for the norm of the k-th rate, |ω_i^(k-1)| ≤ w_i for three body axes.

    On a leg the axis n is fixed in the body and φ is the angle travelled, so ω = φ' n, α = φ'' n, and
    so on: |φ^(k)| ≤ w, or |n_i φ^(k)| ≤ w_i.
    """

    name: str
    order: int
    bounds: Bounds
    couples: ClassVar[bool] = False

    @property
    def power(self) -> int:
        """Of time: the order itself."""
        return self.order

    highest = depth = power

    @property
    def unit(self) -> str:
        """Of the rate."""
        return UNITS[self.order]

    def vector(self, rates: Rates, total: Vector = ZERO) -> Vector:  # noqa: ARG002
        """The k-th rate."""
        return rates[self.order]

    def of(self, rates: Rates, total: Vector = ZERO) -> list[Formula]:
        """V · v ≤ w², or v_i ≤ w_i, v the k-th rate."""
        return bound_vector(self.name, self.vector(rates, total), self.bounds)

    def on(self, axis: Array) -> Sequence[RateRow]:
        """Rows on a leg about `axis` (3,)."""
        whole = [(self.name, 1.0, self.bounds)] if not isinstance(self.bounds, tuple) else []
        return [
            RateRow(self.name, label, UNITS[self.order], self.order, factor, bound)
            for label, factor, bound in whole or split_by_axis(self.name, axis, self.bounds)
        ]

    def bound_rates(self, axes: Array) -> dict[int, Array]:
        """The bound (...) on |d^k φ/dt^k| for legs about many axes (..., 3)."""
        return {self.order: least_quotient(self.bounds, np.asarray(axes))}
