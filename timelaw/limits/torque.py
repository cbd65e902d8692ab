"""Limits on the torque that turns the body: one class for each kind of actuator."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from timelaw.limits.body import EXTERNAL, WHEELS, RigidBody
from timelaw.limits.bounds import AXES, Bounds, bound_vector, least_quotient, split_by_axis
from timelaw.limits.coupled_row import DriftRow, TorqueNormRow, TorqueRow
from timelaw.limits.formula import ZERO, Formula, Rates, Vector, add, apply, cross
from timelaw.limits.limit import Limit
from timelaw.limits.row import RateRow, Row
from timelaw.numerics.array import Array
from timelaw.numerics.ball import list_numbers, measure

UNIT = "N·m"
NOTE = (
    "|H| of {:.6g} N·m·s counts in full: H turns against the body, so that |ω×H| ≤ |ω||H| is all that is used"
)


def make_torque_row(body: RigidBody, axis: Array, bound: float = 1.0) -> TorqueNormRow | None:
    """|τ|² ≤ bound² on a leg about `axis` (3,); None where it is no polynomial in the rates.

    From outside τ = J n φ'' + (n × J n) φ'². Wheels without total momentum do without the second term.
    """
    linear = body.inertia @ axis
    gyroscopic = np.cross(axis, linear)
    sizes = measure(linear), measure(gyroscopic)
    if body.actuator != WHEELS:
        return TorqueNormRow("torque", "torque", UNIT, *sizes, bound**2)
    return None if body.total_momentum else TorqueNormRow("torque", "torque", UNIT, sizes[0], 0.0, bound**2)


@dataclass(frozen=True)
class ExternalTorque:
    """τ = Jα + ω×Jω, Euler's equation, bounded by norm or about three body axes.

    On a leg τ = J n φ'' + (n × J n) φ'².
    """

    name: str
    bounds: Bounds
    body: RigidBody
    couples: ClassVar[bool] = True
    power: ClassVar[int] = 2
    depth: ClassVar[int] = 2
    highest: ClassVar[int] = 2
    unit: ClassVar[str] = UNIT

    def vector(self, rates: Rates, total: Vector = ZERO) -> Vector:  # noqa: ARG002
        """Jα + ω×Jω."""
        matrix = self.body.inertia.tolist()
        return add(apply(matrix, rates[2]), cross(rates[1], apply(matrix, rates[1])))

    def of(self, rates: Rates, total: Vector = ZERO) -> list[Formula]:
        """|Jα + ω×Jω| ≤ τ, or by axis."""
        return bound_vector(self.name, self.vector(rates, total), self.bounds)

    def on(self, axis: Array) -> Sequence[Row]:
        """Rows on a leg about `axis` (3,)."""
        if not isinstance(self.bounds, tuple):
            row = make_torque_row(self.body, axis, self.bounds)
            return [] if row is None else [row]
        linear = self.body.inertia @ axis
        gyroscopic = np.cross(axis, linear)
        return [
            TorqueRow(self.name, f"{self.name} {name}", UNIT, a, b, bound)
            for name, a, b, bound in zip(
                AXES, list_numbers(linear), list_numbers(gyroscopic), self.bounds, strict=True
            )
        ]

    def bound_rates(self, axes: Array) -> dict[int, Array]:  # noqa: ARG002
        """None: what is left for φ'' depends on φ'."""
        return {}


@dataclass(frozen=True)
class WheelTorque:
    """τ = Jα + ω×H, the torque of reaction wheels; H is the total angular momentum, often zero.

    On a leg with H = 0, τ = J n φ'': a plain bound on φ''. Otherwise H turns against the body, and
    (n×H)_i ≤ |H| √(1 - n_i²), |n×H| ≤ |H| bound the second term: |J n φ''| + |H| |φ'| ≤ τ and the like.
    """

    name: str
    bounds: Bounds
    body: RigidBody
    power: ClassVar[int] = 2
    depth: ClassVar[int] = 2
    highest: ClassVar[int] = 2
    unit: ClassVar[str] = UNIT

    @property
    def couples(self) -> bool:
        """Only where the total momentum is not zero."""
        return bool(self.body.total_momentum)

    def vector(self, rates: Rates, total: Vector = ZERO) -> Vector:
        """Jα + ω×H, `total` being H (3,) in body axes at that instant."""
        return add(apply(self.body.inertia.tolist(), rates[2]), cross(rates[1], total))

    def of(self, rates: Rates, total: Vector = ZERO) -> list[Formula]:
        """|Jα + ω×H| ≤ τ, or by axis."""
        return bound_vector(self.name, self.vector(rates, total), self.bounds)

    def on(self, axis: Array) -> Sequence[Row]:
        """Rows on a leg about `axis` (3,)."""
        factors = list(split_by_axis(self.name, self.body.inertia @ axis, self.bounds))
        total = self.body.total_momentum
        if not total:
            return [RateRow(self.name, label, UNIT, 2, a, bound) for label, a, bound in factors]
        aslant = [1.0] if len(factors) == 1 else [measure(np.cross(side, axis)) for side in np.eye(3)]
        return [
            DriftRow(self.name, label, UNIT, a, sense * part * total, bound, NOTE.format(total))
            for (label, a, bound), part in zip(factors, aslant, strict=True)
            for sense in (1.0, -1.0)
        ]

    def bound_rates(self, axes: Array) -> dict[int, Array]:
        """The bound (...) on |φ''| for legs about many axes (..., 3), where it is one."""
        return {} if self.couples else {2: least_quotient(self.bounds, axes @ self.body.inertia.T)}


ACTUATORS: dict[str, Callable[[str, Bounds, RigidBody], Limit]] = {
    EXTERNAL: ExternalTorque,
    WHEELS: WheelTorque,
}
TORQUE_FORMULAS = {
    EXTERNAL: "Torque from outside: τ = Jα + ω×Jω; momentum: Jω.",
    WHEELS: "Torque of reaction wheels: τ = Jα + ω×H, H the total angular momentum; stored momentum: H − Jω.",
}
