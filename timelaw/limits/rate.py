"""Norm limits on the angular velocity, acceleration and jerk: one class with an order."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

UNITS = {1: "rad/s", 2: "rad/s²", 3: "rad/s³"}


class Row(NamedTuple):
    """One scalar demand on a leg, |value| ≤ bound at every instant; `label` says of what."""

    label: str
    value: Any
    bound: float


@dataclass(frozen=True)
class Rate:
    """|d^k φ/dt^k| ≤ bound, φ the angle travelled.

    On a leg the axis is fixed in the body, so |ω| = |φ'|, |α| = |φ''| and |j| = |φ'''|.
    """

    name: str
    order: int
    bound: float

    @property
    def orders(self) -> tuple[int, ...]:
        """Which time derivatives of the angle the rows are made of."""
        return (self.order,)

    @property
    def unit(self) -> str:
        """Unit of the bound."""
        return UNITS[self.order]

    def rows(self, rates: Mapping[int, Any]) -> tuple[Row, ...]:
        """Rows for one leg; `rates[k]` is the k-th time derivative of the angle, in whatever form.

        Symbols of the solver, control points of a polynomial, or numbers.
        """
        return (Row(self.name, rates[self.order], self.bound),)

    def stretch(self, ratio: float) -> float:
        """Factor on time that brings a peak of `ratio` times the bound down to it: ratio^(1/k)."""
        return float(ratio ** (1 / self.order))
