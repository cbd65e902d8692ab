"""Limits on angular velocity, acceleration, jerk and snap: one class with an order."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from timelaw.limits.bounds import AXES, Bounds, least_quotient
from timelaw.limits.row import RateRow
from timelaw.numerics.array import Array

UNITS = {1: "rad/s", 2: "rad/s²", 3: "rad/s³", 4: "rad/s⁴"}


@dataclass(frozen=True)
class Rate:
    """|d^k φ/dt^k| ≤ w for a norm, |n_i d^k φ/dt^k| ≤ w_i for three body axes.

    φ is the angle travelled: on a leg the axis n is fixed in the body, so ω = φ' n, α = φ'' n,
    j = φ''' n.
    """

    name: str
    order: int
    bounds: Bounds
    couples: ClassVar[bool] = False

    def on(self, axis: Array) -> tuple[RateRow, ...]:
        """Rows on a leg about `axis` (3,)."""
        unit = UNITS[self.order]
        if not isinstance(self.bounds, tuple):
            return (
                RateRow(self.name, self.name, unit, self.order, float(np.linalg.norm(axis)), self.bounds),
            )
        return tuple(
            RateRow(self.name, f"{self.name} {name}", unit, self.order, float(n), bound)
            for name, n, bound in zip(AXES, axis, self.bounds, strict=True)
        )

    def bound_rates(self, axes: Array) -> dict[int, Array]:
        """The bound (...) on |d^k φ/dt^k| for legs about many axes (..., 3)."""
        if not isinstance(self.bounds, tuple):
            return {self.order: np.asarray(self.bounds / np.linalg.norm(axes, axis=-1))}
        return {self.order: least_quotient(self.bounds, axes)}
