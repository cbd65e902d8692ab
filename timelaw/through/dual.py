"""Numbers that carry their slopes by many variables: what formulas become when they are differentiated.

a + b, a·b and a^e of values (...) with slopes (..., v) by the rules of differentiation, exact but for
rounding. Formulas of vectors and quaternions that know + and × take them as they are.
"""

from dataclasses import dataclass
from typing import Union

import numpy as np

from timelaw.numerics.array import Array

Plain = Union[float, Array]  # noqa: UP007 - a union of types at run time


@dataclass(frozen=True, eq=False)
class Dual:
    """A value (...) and its slopes (..., v)."""

    value: Array
    slope: Array
    __array_ufunc__ = None  # an array times a dual is for the dual to say

    def __add__(self, other: "Dual | Plain") -> "Dual":
        if isinstance(other, Dual):
            return Dual(self.value + other.value, self.slope + other.slope)
        return Dual(self.value + other, self.slope)

    __radd__ = __add__

    def __mul__(self, other: "Dual | Plain") -> "Dual":
        if isinstance(other, Dual):
            slope = self.value[..., None] * other.slope + other.value[..., None] * self.slope
            return Dual(self.value * other.value, slope)
        return Dual(self.value * other, self.slope * np.asarray(other)[..., None])

    __rmul__ = __mul__

    def __pow__(self, exponent: float) -> "Dual":
        power = np.asarray(exponent * self.value ** (exponent - 1))
        return Dual(np.asarray(self.value**exponent), power[..., None] * self.slope)


def seed(values: Array, first: int, count: int) -> list[Dual]:
    """Values (..., n) as n duals, which are the variables from `first` on, of `count`."""
    slopes = np.eye(count)[first : first + values.shape[-1]]
    shape = (*values.shape[:-1], count)
    return [Dual(values[..., k], np.broadcast_to(slope, shape)) for k, slope in enumerate(slopes)]


def stack(components: "list[Dual | Array]") -> Array:
    """Values of components, on a new last axis (..., n)."""
    return np.stack(np.broadcast_arrays(*(value_of(c) for c in components)), axis=-1)


def value_of(number: "Dual | Plain") -> Array:
    """The value, slopes apart."""
    return number.value if isinstance(number, Dual) else np.asarray(number)


def stack_slopes(components: "list[Dual | Array]", like: Dual) -> Array:
    """Slopes of components (..., n, v), zero for those that are constant; `like` has their shape."""
    none = np.zeros(like.slope.shape)
    return np.stack([c.slope if isinstance(c, Dual) else none for c in components], axis=-2)
