"""Numbers that carry their slopes: what limits' formulas need to be known to first order."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from timelaw.numerics.array import Array


@dataclass(frozen=True)
class Dual:
    """Values (m,) and their slopes (m, n) by n variables; knows + and ×, as limits' formulas ask."""

    value: Array
    slope: Array

    def __add__(self, other: Any) -> "Dual":
        if isinstance(other, Dual):
            return Dual(self.value + other.value, self.slope + other.slope)
        return Dual(self.value + other, self.slope)

    def __mul__(self, other: Any) -> "Dual":
        if isinstance(other, Dual):
            slope = self.slope * other.value[:, None] + other.slope * self.value[:, None]
            return Dual(self.value * other.value, slope)
        return Dual(self.value * other, self.slope * other)

    __radd__ = __add__
    __rmul__ = __mul__


def make_variables(values: Array) -> list[Dual]:
    """The columns of values (m, n), each a variable."""
    count = values.shape[1]
    return [Dual(values[:, k], np.broadcast_to(np.eye(count)[k], values.shape)) for k in range(count)]
