"""∫ |v|² dt over a curve, v one of the vectors that limits bound: as a number, and as squares to first order.

By Gauss-Legendre's rule on each piece, ∫ |v|² dt = Σ w h |V|²/h^2k: the squares of r = √(w h) V/h^k.
"""

from functools import cache

import numpy as np
from scipy import sparse

from timelaw.limits import make_limits
from timelaw.limits.body import RigidBody
from timelaw.limits.formula import ZERO
from timelaw.numerics.array import Array
from timelaw.through.columns import Columns
from timelaw.through.curve import Curve
from timelaw.through.dual import stack
from timelaw.through.kinematics import list_rates, make_basis
from timelaw.through.measures import LimitMeasure
from timelaw.through.rows import derive_vector, look_at

NODES = 12  # on each piece
VECTORS = {"energy": "acceleration", "jerk": "jerk", "snap": "snap", "torque": "torque"}  # by effort


@cache
def _rule() -> tuple[Array, Array]:
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    return (nodes + 1) / 2, weights / 2


def measure_vector(effort: str, legs: int, body: RigidBody | None) -> LimitMeasure:
    """What is squared, as the limit on it sees it."""
    (limit,) = make_limits({VECTORS[effort]: 1.0}, body)
    return LimitMeasure(limit, np.ones((legs, 1)), ZERO)


def measure_effort(curve: Curve, vector: LimitMeasure) -> float:
    """∫ |v|² dt."""
    nodes, weights = _rule()
    basis = make_basis(curve.degree, nodes, vector.highest)
    states = np.einsum("mko,poc->kcpm", basis, curve.control())
    h = curve.steps[:, None]
    legs = np.repeat(np.arange(len(curve.duration)), curve.pieces)[:, None]
    value = stack(list(vector.vector(states, list_rates(states), h, legs)))
    return float(np.sum(np.sum(value**2, axis=-1) * weights * h ** (1 - 2 * vector.power)))


def list_residuals(curve: Curve, columns: Columns, vector: LimitMeasure) -> tuple[Array, sparse.csr_matrix]:
    """The r (n,) whose squares add up to the effort, and their slopes (n, count) by the variables."""
    nodes, weights = _rule()
    pieces = len(curve.weight)
    piece, at = np.repeat(np.arange(pieces), NODES), np.tile(nodes, pieces)
    seen = look_at(curve, columns.by_clock(curve, curve.slopes()), piece, at, vector.highest)
    value, slope, by_step = derive_vector(curve, vector, seen, np.arange(len(piece)))
    h, k = curve.steps[piece], vector.power
    own = 2 * curve.columns[0]
    slope[..., own] += by_step + value * ((0.5 - k) / h)[:, None]
    factor = np.sqrt(np.tile(weights, pieces) * h) / h**k
    value, slope = value * factor[:, None], slope * factor[:, None, None]
    where = np.broadcast_to(columns.of_pieces[piece][:, None], slope.shape)
    row = np.broadcast_to(np.arange(value.size).reshape(*value.shape, 1), slope.shape)
    free = where >= 0
    matrix = sparse.csr_matrix((slope[free], (row[free], where[free])), shape=(value.size, columns.count))
    return value.ravel(), matrix
