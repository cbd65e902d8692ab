"""Limits on the stored angular momentum, as reaction wheels have them."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from timelaw.limits.bounds import AXES, Bounds, least_quotient
from timelaw.limits.row import RateRow
from timelaw.numerics.array import Array

UNIT = "N·m·s"


@dataclass(frozen=True)
class Momentum:
    """|J n φ'| ≤ h for the norm, |(J n)_i φ'| ≤ h_i for three body axes; `inertia` J (3, 3) [kg·m²]."""

    name: str
    bounds: Bounds
    inertia: Array
    couples: ClassVar[bool] = False

    def on(self, axis: Array) -> tuple[RateRow, ...]:
        """Rows on a leg about `axis` (3,)."""
        momentum = self.inertia @ axis
        if not isinstance(self.bounds, tuple):
            size = float(np.linalg.norm(momentum))
            return (RateRow(self.name, self.name, UNIT, 1, size, self.bounds),)
        return tuple(
            RateRow(self.name, f"{self.name} {name}", UNIT, 1, float(h), bound)
            for name, h, bound in zip(AXES, momentum, self.bounds, strict=True)
        )

    def bound_rates(self, axes: Array) -> dict[int, Array]:
        """The bound (...) on |φ'| for legs about many axes (..., 3)."""
        momentum = axes @ self.inertia.T
        if not isinstance(self.bounds, tuple):
            return {1: np.asarray(self.bounds / np.linalg.norm(momentum, axis=-1))}
        return {1: least_quotient(self.bounds, momentum)}
