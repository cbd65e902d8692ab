"""The pieces of many rational segments as one stack, for values at many instants."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from timelaw.motion.quaternion_curve import (
    CurveStack,
    differentiate_curves,
    find_rates,
    stack_curves,
)
from timelaw.motion.rational import Rational
from timelaw.numerics.array import Array
from timelaw.numerics.chebyshev import ChebyshevStack, Points, Rows


@dataclass(frozen=True)
class RationalStack:
    """q = Q/|Q| and its rates from Q and its derivatives in time, pieces of one degree together."""

    curves: Sequence[CurveStack]
    _known: dict[int, ChebyshevStack] = field(default_factory=dict, init=False, repr=False, compare=False)

    @classmethod
    def stack(cls, segments: Sequence[Rational]) -> "RationalStack":
        """The pieces of all, one after another."""
        return cls(list(stack_curves([piece for segment in segments for piece in segment.pieces])))

    @cached_property
    def durations(self) -> Array:
        """How long the pieces last (N,) [s]."""
        numbers = np.concatenate([stack.piece for stack in self.curves])
        return np.concatenate([stack.duration for stack in self.curves])[np.argsort(numbers)]

    def fill(self, rows: Rows, points: Points, values: Mapping[int, Array]) -> None:
        """Write q (m, 4) and rates (m, 3), by order, at points of one row, or of the row of each.

        Not finite where Q is zero.
        """
        q = [self._curve(order)(rows, points) for order in range(max(values) + 1)]
        with np.errstate(divide="ignore", invalid="ignore"):
            found = find_rates(q)
        for order, value in values.items():
            value[:] = found[order].T

    def _curve(self, order: int) -> ChebyshevStack:
        """The k-th derivative of Q in time."""
        if order not in self._known:
            controls = [
                (stack.piece, differentiate_curves(stack.control, stack.duration, order))
                for stack in self.curves
            ]
            self._known[order] = ChebyshevStack.join(controls)
        return self._known[order]
