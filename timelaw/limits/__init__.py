"""Limits: what the body's motion on a leg may not exceed, each a bound on polynomials in time."""

from timelaw.limits.limit import LIMITS, limits_of
from timelaw.limits.rate import Rate, Row

__all__ = ["LIMITS", "Rate", "Row", "limits_of"]
