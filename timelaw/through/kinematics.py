"""The rates of pieces in the time of each, X_k = h^k times the k-th rate, as numbers or with their slopes.

With v(a, b) = Vec(ā b), ω D = 2 v(Q, Q') and D = Q·Q; the derivatives of both sides by Leibniz' rule,
solved for the highest of ω, are α, jerk and snap: no powers of D, and so nothing cancels.
"""

from collections.abc import Sequence
from math import comb
from typing import Any

import numpy as np

from timelaw.limits.formula import Vector, conjugate, dot4, product
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import basis_matrix

States = Sequence[Vector]  # Q and its derivatives, four components each


def make_basis(degree: int, u: Array, highest: int) -> Array:
    """(m, highest + 1, d+1): at each u the Bernstein polynomials and their derivatives."""
    return np.stack([basis_matrix(degree, u, k) for k in range(highest + 1)], axis=1)


def list_rates(q: States) -> dict[int, Vector]:
    """X_k (3) for k = 1 … the highest derivative of Q that is there."""
    squares = [
        _add([dot4(q[i], q[k - i]) * float(comb(k, i)) for i in range(k + 1)]) for k in range(len(q) - 1)
    ]
    over = squares[0] ** -1.0
    rates: dict[int, Vector] = {}
    for k in range(len(q) - 1):
        turns = [(2.0 * comb(k, i), product(conjugate(q[i]), q[k - i + 1])[1:]) for i in range(k + 1)]
        parts = [[c * factor for c in vector] for factor, vector in turns]
        parts += [
            [c * (squares[k - i] * -float(comb(k, i))) for c in rate] for i, rate in enumerate(rates.values())
        ]
        rates[k + 1] = [_add(column) * over for column in zip(*parts, strict=True)]
    return rates


def turn_back(q: Vector, vector: Vector) -> Vector:
    """A constant vector (3) of the world in body axes."""
    inner = [0.0, *(float(part) for part in vector)]
    over = dot4(q, q) ** -1.0
    return [part * over for part in product(product(conjugate(q), inner), q)[1:]]


def _add(parts: Sequence[Any]) -> Any:
    """Σ, of whatever numbers."""
    return sum(parts[1:], parts[0])
