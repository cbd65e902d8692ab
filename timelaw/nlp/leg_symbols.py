"""One leg as the solver knows it: symbols of its duration and coefficients, and its rates made of them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from timelaw.easing.family import Basis
from timelaw.numerics.array import Array

SPARSE = 1e-15  # of the largest entry of a column; rows are checked on the law itself afterwards


@dataclass
class LegSymbols:
    """Symbols of one leg: duration [s], derivatives at both ends, free coefficients."""

    duration: Any
    left: Any
    free: Any
    right: Any

    def apply(self, basis: Basis, matrix: Array | None = None) -> Any:
        """Control points, or a matrix times them; constants lose their zeros, most of a spline's."""
        parts = ((basis.from_left, self.left), (basis.from_free, self.free), (basis.from_right, self.right))
        return sum(_sparse(part if matrix is None else matrix @ part) @ symbol for part, symbol in parts)


def rates_at(
    angle: float, leg: LegSymbols, basis: Basis, tau: Array, orders: Sequence[int]
) -> dict[int, Any]:
    """Rates of the angle at the points τ."""
    return {k: angle / leg.duration**k * leg.apply(basis, basis.values(tau, k)) for k in orders}


def _sparse(matrix: Array) -> Any:
    """A constant without its zeros and what is only rounding."""
    rounding = SPARSE * np.max(np.abs(matrix), axis=0, initial=0.0)
    return ca.sparsify(ca.DM(np.where(np.abs(matrix) > rounding, matrix, 0.0)))
