"""Rows: what a limit demands on one leg, a bound on a polynomial in the rates of the angle.

Along a leg the axis n stays the same in the body, so each limit becomes |g(φ', φ'', …)| ≤ bound at
every instant, g a polynomial. `rates[k]` is the k-th time derivative of the angle in whatever
form: symbols of the solver, polynomials in time, or arrays of numbers.

Stretching time by c divides g by c^power, because every row is homogeneous; `root` says that g is
the root-th power of the limited quantity (2 for norms of vectors), so the fraction of the limit
used is (|g|/bound)^(1/root). `limit` is the key a row comes from, `label` names the axis too;
`coefficients` tell rows of one label apart.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar


@dataclass(frozen=True)
class RateRow:
    """|factor φ^(order)| ≤ bound."""

    limit: str
    label: str
    unit: str
    order: int
    factor: float
    bound: float
    root: ClassVar[int] = 1

    @property
    def orders(self) -> tuple[int, ...]:
        """The one order."""
        return (self.order,)

    @property
    def power(self) -> int:
        """Time scaling: the order itself."""
        return self.order

    def value(self, rates: Mapping[int, Any]) -> Any:
        """Factor times the rate."""
        return self.factor * rates[self.order]

    def coefficients(self) -> tuple[float, ...]:
        """Factor and bound."""
        return (self.factor, self.bound)

    def effective(self) -> float:
        """The bound on |φ^(order)| itself; infinite where the axis has no such component."""
        return self.bound / abs(self.factor) if self.factor else float("inf")


@dataclass(frozen=True)
class TorqueRow:
    """|linear φ'' + gyroscopic φ'²| ≤ bound: one axis of τ = J n φ'' + (n × J n) φ'²."""

    limit: str
    label: str
    unit: str
    linear: float
    gyroscopic: float
    bound: float
    orders: ClassVar[tuple[int, ...]] = (1, 2)
    power: ClassVar[int] = 2
    root: ClassVar[int] = 1

    def value(self, rates: Mapping[int, Any]) -> Any:
        """The torque about one axis."""
        return self.linear * rates[2] + self.gyroscopic * (rates[1] * rates[1])

    def coefficients(self) -> tuple[float, ...]:
        """Both factors and the bound."""
        return (self.linear, self.gyroscopic, self.bound)


@dataclass(frozen=True)
class TorqueNormRow:
    """linear² φ''² + gyroscopic² φ'⁴ ≤ bound, a square: J n and n × J n are at right angles."""

    limit: str
    label: str
    unit: str
    linear: float
    gyroscopic: float
    bound: float
    orders: ClassVar[tuple[int, ...]] = (1, 2)
    power: ClassVar[int] = 4
    root: ClassVar[int] = 2

    def value(self, rates: Mapping[int, Any]) -> Any:
        """The square of the torque."""
        square = rates[1] * rates[1]
        return self.linear**2 * (rates[2] * rates[2]) + self.gyroscopic**2 * (square * square)

    def coefficients(self) -> tuple[float, ...]:
        """Both factors and the bound."""
        return (self.linear, self.gyroscopic, self.bound)


Row = RateRow | TorqueRow | TorqueNormRow
