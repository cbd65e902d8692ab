"""Rows that tie the angle's second rate to its first: torque on a leg, whoever exerts it."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, sqrt
from typing import Any, ClassVar


class Coupled:
    """What rows have in common that tie φ'' to φ'."""

    orders: ClassVar[tuple[int, ...]] = (1, 2)
    couples: ClassVar[bool] = True
    root: ClassVar[int] = 1

    def size(self, value: float) -> float:
        """What is limited."""
        return float(value ** (1 / self.root))

    def rate_bound(self, order: int) -> float:  # noqa: ARG002
        """No bound on one rate alone."""
        return inf


@dataclass(frozen=True)
class Gyroscopic(Coupled):
    """Rows of a torque that has a part in φ'' and one in φ'²."""

    limit: str
    label: str
    unit: str
    linear: Any
    gyroscopic: Any
    bound: float
    note: ClassVar[str] = ""

    def coefficients(self) -> tuple[float, ...]:
        """Both factors and the bound."""
        return (self.linear, self.gyroscopic, self.bound)


@dataclass(frozen=True)
class TorqueRow(Gyroscopic):
    """|linear φ'' + gyroscopic φ'²| ≤ bound: one axis of τ = J n φ'' + (n × J n) φ'²."""

    powers: ClassVar[tuple[int, ...]] = (2,)

    def value(self, rates: Mapping[int, Any]) -> Any:
        """The torque about one axis."""
        return self.linear * rates[2] + self.gyroscopic * (rates[1] * rates[1])

    def speed_limit(self) -> float:
        """Where the gyroscopic torque alone reaches the bound."""
        return sqrt(self.bound / abs(self.gyroscopic)) if self.gyroscopic else inf

    def acceleration_limits(self, v: float) -> tuple[float, float]:
        """What the gyroscopic torque leaves on either side."""
        if not self.linear:
            return inf, inf
        drift = self.gyroscopic * v * v * (1 if self.linear > 0 else -1)
        up, down = max(self.bound - drift, 0.0), max(self.bound + drift, 0.0)
        return up / abs(self.linear), down / abs(self.linear)


@dataclass(frozen=True)
class TorqueNormRow(Gyroscopic):
    """linear² φ''² + gyroscopic² φ'⁴ ≤ bound, a square: J n and n × J n are at right angles."""

    powers: ClassVar[tuple[int, ...]] = (4,)
    root: ClassVar[int] = 2

    def value(self, rates: Mapping[int, Any]) -> Any:
        """The square of the torque."""
        square = rates[1] * rates[1]
        return self.linear**2 * (rates[2] * rates[2]) + self.gyroscopic**2 * (square * square)

    def speed_limit(self) -> float:
        """Where the gyroscopic torque alone reaches the bound."""
        return float((self.bound / self.gyroscopic**2) ** 0.25) if self.gyroscopic else inf

    def acceleration_limits(self, v: float) -> tuple[float, float]:
        """What the gyroscopic torque leaves, the same on both sides."""
        left = sqrt(max(self.bound - (self.gyroscopic * v * v) ** 2, 0.0)) / self.linear
        return left, left


@dataclass(frozen=True)
class DriftRow(Coupled):
    """|linear φ'' + drift φ'| ≤ bound; with its twin of the other sign |linear φ''| + |drift φ'| ≤ bound."""

    limit: str
    label: str
    unit: str
    linear: Any
    drift: Any
    bound: float
    note: str = ""
    powers: ClassVar[tuple[int, ...]] = (1, 2)

    def value(self, rates: Mapping[int, Any]) -> Any:
        """The torque about one axis, or its norm, at worst."""
        return self.linear * rates[2] + self.drift * rates[1]

    def coefficients(self) -> tuple[float, ...]:
        """Both factors and the bound."""
        return (self.linear, self.drift, self.bound)

    def speed_limit(self) -> float:
        """Where the drift alone reaches the bound."""
        return self.bound / abs(self.drift) if self.drift else inf

    def acceleration_limits(self, v: float) -> tuple[float, float]:
        """What the drift leaves, the twin counted: the same on both sides."""
        left = max(self.bound - abs(self.drift * v), 0.0)
        return (left / abs(self.linear),) * 2 if self.linear else (inf, inf)
