"""Limits: what the body's motion may not exceed, on each leg a bound on polynomials in time."""

from timelaw.limits.momentum import Momentum
from timelaw.limits.rate import Rate
from timelaw.limits.registry import LIMITS, Limit, binding, limits_of, rows_on
from timelaw.limits.row import RateRow, Row, TorqueNormRow, TorqueRow
from timelaw.problem.body import Bounds
from timelaw.problem.model import NEEDS_INERTIA

__all__ = [
    "LIMITS",
    "NEEDS_INERTIA",
    "Bounds",
    "Limit",
    "Momentum",
    "Rate",
    "RateRow",
    "Row",
    "TorqueNormRow",
    "TorqueRow",
    "binding",
    "limits_of",
    "rows_on",
]
