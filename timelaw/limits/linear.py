"""Limits on the linear velocity and acceleration of the body's origin, which moves in the world."""

from dataclasses import dataclass
from typing import ClassVar

from timelaw.limits.bounds import Bounds, bound_vector
from timelaw.limits.formula import LINEAR, ZERO, Formula, Rates, Vector
from timelaw.limits.row import RateRow
from timelaw.numerics.array import Array

UNITS = {1: "m/s", 2: "m/s²"}


@dataclass(frozen=True)
class LinearRate:
    """|c^(k)| ≤ w for the norm, |c_i^(k)| ≤ w_i for the three axes of the world; c is the body's origin.

    With c = P/D the k-th derivative is a polynomial over D^(k+1). It asks nothing of a leg that only turns.
    """

    name: str
    order: int
    bounds: Bounds
    couples: ClassVar[bool] = False
    highest: ClassVar[int] = 0

    @property
    def power(self) -> int:
        """Of time: the order itself."""
        return self.order

    @property
    def depth(self) -> int:
        """Of D: one more than the order."""
        return self.order + 1

    @property
    def unit(self) -> str:
        """Of the rate."""
        return UNITS[self.order]

    def vector(self, rates: Rates, total: Vector = ZERO) -> Vector:  # noqa: ARG002
        """The k-th derivative of the origin's place, in the world."""
        return rates[LINEAR[self.order]]

    def of(self, rates: Rates, total: Vector = ZERO) -> list[Formula]:
        """V · v ≤ w², or v_i ≤ w_i in the world."""
        return bound_vector(self.name, self.vector(rates, total), self.bounds)

    def on(self, axis: Array) -> list[RateRow]:  # noqa: ARG002
        """None: on an arc the origin rests."""
        return []

    def bound_rates(self, axes: Array) -> dict[int, Array]:  # noqa: ARG002
        """None."""
        return {}
