"""Balls: numbers that know how far rounding may have taken them from the exact ones.

Only what coefficients of limits need, so that J n, n × J n and norms are bounded where their terms cancel.
Arrays of balls are NumPy arrays of objects: sums, matrix products and cross products work on them.
"""

from dataclasses import dataclass
from math import inf, nextafter, sqrt

import numpy as np
from numpy.typing import ArrayLike

from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import UNIT_ROUNDOFF

ABOVE = 1 + 8 * UNIT_ROUNDOFF  # an error is a sum of up to four products, each rounded
LEAST = 5e-324  # the spacing of numbers near zero, where rounding is not relative


@dataclass(frozen=True)
class Ball:
    """The exact number is within `error` of `value`; so it is of all that is made of balls."""

    value: float
    error: float = 0.0

    @property
    def upper(self) -> float:
        """No exact number of the ball is larger in size."""
        return nextafter((abs(self.value) + self.error), inf) if self.error else abs(self.value)

    def __add__(self, other: "Ball | float") -> "Ball":
        other = make_ball(other)
        return _round(self.value + other.value, self.error + other.error)

    def __float__(self) -> float:
        return self.value

    def __bool__(self) -> bool:
        return self.value != 0 or self.error != 0

    def __neg__(self) -> "Ball":
        return Ball(-self.value, self.error)

    def __sub__(self, other: "Ball | float") -> "Ball":
        return self + -make_ball(other)

    def __rsub__(self, other: "Ball | float") -> "Ball":
        return -self + other

    def __mul__(self, other: "Ball | float") -> "Ball":
        if not isinstance(other, Ball | float | int):
            return NotImplemented
        other = make_ball(other)
        carried = self.error * abs(other.value) + other.error * (abs(self.value) + self.error)
        return _round(self.value * other.value, carried)

    def __truediv__(self, other: "Ball | float") -> "Ball":
        other = make_ball(other)
        least = abs(other.value) - other.error
        if not least > 0:
            return Ball(0.0, inf)
        quotient = self.value / other.value
        return _round(
            quotient, (self.error + abs(quotient) * other.error) / (least * (1 - 4 * UNIT_ROUNDOFF))
        )

    def __pow__(self, power: int) -> "Ball":
        result = Ball(1.0)
        for _ in range(power):
            result = result * self
        return result

    def sqrt(self) -> "Ball":
        """Of what is not negative; a ball that reaches below zero is cut there."""
        low, high = sqrt(max(self.value - self.error, 0.0)), sqrt(max(self.value + self.error, 0.0))
        return _round((low + high) / 2, (high - low) / 2 + 2 * UNIT_ROUNDOFF * high)

    __radd__ = __add__
    __rmul__ = __mul__


Number = float | Ball


def make_ball(value: "Ball | float") -> Ball:
    """An exact number as a ball."""
    return value if isinstance(value, Ball) else Ball(float(value))


def _round(value: float, carried: float) -> Ball:
    """The result of one operation: what its operands carry, and its own rounding."""
    if carried == 0 and value == 0:
        return Ball(0.0)  # of zeros only, or so far below all bounds that it is one
    return Ball(value, (carried + UNIT_ROUNDOFF * abs(value)) * ABOVE + LEAST)


def enclose_direction(vector: ArrayLike) -> Array:
    """The unit vector (3,) along a vector of floats, as balls."""
    balls = np.array([Ball(float(component)) for component in np.asarray(vector)], dtype=object)
    size = (balls @ balls).sqrt()
    return np.array([component / size for component in balls], dtype=object)


def measure(vector: Array) -> Number:
    """The norm of a vector (3,): a float, or a ball where its components are balls."""
    if vector.dtype != object:
        return float(np.linalg.norm(vector))
    square: Ball = np.dot(vector, vector)
    return square.sqrt()


def list_numbers(vector: Array) -> list[Number]:
    """The components of a vector: floats, or balls."""
    return list(vector) if vector.dtype == object else [float(component) for component in vector]
