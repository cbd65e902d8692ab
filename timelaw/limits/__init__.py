"""Limits: what the body's motion may not exceed, on each leg a bound on polynomials in time."""

from timelaw.limits.bounds import Bounds
from timelaw.limits.demand import Demand
from timelaw.limits.limit import Limit, LimitKind
from timelaw.limits.registry import LIMITS, list_rows, make_limits
from timelaw.limits.row import BoundRow, Row, drop_implied

__all__ = [
    "LIMITS",
    "BoundRow",
    "Bounds",
    "Demand",
    "Limit",
    "LimitKind",
    "Row",
    "drop_implied",
    "list_rows",
    "make_limits",
]
