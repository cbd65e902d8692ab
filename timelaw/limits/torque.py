"""Limits on the torque that turns the body: Euler's equation along a leg."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from timelaw.limits.bounds import AXES, Bounds
from timelaw.limits.row import TorqueNormRow, TorqueRow
from timelaw.numerics.array import Array

UNIT = "N·m"


def square_torque(inertia: Array, axis: Array, bound: float = 1.0) -> TorqueNormRow:
    """|τ|² ≤ bound² on a leg about `axis` (3,)."""
    linear = inertia @ axis
    gyroscopic = np.cross(axis, linear)
    sizes = float(np.linalg.norm(linear)), float(np.linalg.norm(gyroscopic))
    return TorqueNormRow("torque", "torque", UNIT, *sizes, bound**2)


@dataclass(frozen=True)
class Torque:
    """τ = J ω' + ω × J ω = J n φ'' + (n × J n) φ'², bounded by norm or about three body axes.

    `inertia` J (3, 3) [kg·m²] in the same body axes as everything else.
    """

    name: str
    bounds: Bounds
    inertia: Array
    couples: ClassVar[bool] = True

    def on(self, axis: Array) -> tuple[TorqueRow, ...] | tuple[TorqueNormRow]:
        """Rows on a leg about `axis` (3,)."""
        linear = self.inertia @ axis
        gyroscopic = np.cross(axis, linear)
        if not isinstance(self.bounds, tuple):
            return (square_torque(self.inertia, axis, self.bounds),)
        return tuple(
            TorqueRow(self.name, f"{self.name} {name}", UNIT, float(a), float(b), bound)
            for name, a, b, bound in zip(AXES, linear, gyroscopic, self.bounds, strict=True)
        )

    def bound_rates(self, axes: Array) -> dict[int, Array]:  # noqa: ARG002
        """None: what is left for φ'' depends on φ'."""
        return {}
