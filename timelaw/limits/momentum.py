"""Limits on the stored angular momentum, as reaction wheels have them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from timelaw.limits.body import RigidBody
from timelaw.limits.bounds import Bounds, bound_vector, least_quotient, lessen, split_by_axis
from timelaw.limits.formula import ZERO, Formula, Rates, Vector, apply, subtract
from timelaw.limits.row import RateRow
from timelaw.numerics.array import Array

UNIT = "N·m·s"
NOTE = "|H| of {:.6g} N·m·s counts in full, for it turns against the body: |H - Jω| ≤ |H| + |Jω| is used"
ROUNDING = 1e-9  # relative; so little left for the body to turn with is what rounding left


@dataclass(frozen=True)
class Momentum:
    """|H - Jω| ≤ h for the norm, |(H - Jω)_i| ≤ h_i for three body axes; H = 0 unless the body has some.

    On a leg H - J n φ' is bounded by |H| + |J n φ'|, since H turns against the body: |J n φ'| ≤ h - |H|.
    """

    name: str
    bounds: Bounds
    body: RigidBody
    power: ClassVar[int] = 1
    depth: ClassVar[int] = 1
    highest: ClassVar[int] = 1
    unit: ClassVar[str] = UNIT

    @property
    def couples(self) -> bool:
        """It bounds φ' alone."""
        return False

    def vector(self, rates: Rates, total: Vector = ZERO) -> Vector:
        """H - Jω, `total` being H (3,) in body axes at that instant."""
        return subtract(total, apply(self.body.inertia.tolist(), rates[1]))

    def of(self, rates: Rates, total: Vector = ZERO) -> list[Formula]:
        """|H - Jω| ≤ h, or by axis."""
        return bound_vector(self.name, self.vector(rates, total), self.bounds)

    def on(self, axis: Array) -> Sequence[RateRow]:
        """Rows on a leg about `axis` (3,)."""
        total = self.body.total_momentum
        note = NOTE.format(total) if total else ""
        left = lessen(self.bounds, total)
        return [
            RateRow(self.name, label, UNIT, 1, factor, bound, total, note)
            for label, factor, bound in split_by_axis(self.name, self.body.inertia @ axis, left)
        ]

    def bound_rates(self, axes: Array) -> dict[int, Array]:
        """The bound (...) on |φ'| for legs about many axes (..., 3)."""
        return {1: least_quotient(lessen(self.bounds, self.body.total_momentum), axes @ self.body.inertia.T)}


def find_contradiction(bounds: Bounds, body: RigidBody) -> str:
    """Why a limit on the stored momentum can hold at no time at all; empty if it can."""
    total, given = body.total_momentum, float(np.min(bounds))
    if total < given * (1 - ROUNDING):
        return ""
    return f"the total momentum |H| is {total:.6g} N*m*s; a limit above it is needed, not {given:.6g} N*m*s"
