"""Objectives: what the nonlinear program makes least."""

from timelaw.objectives.integral import effort_of
from timelaw.objectives.objective import EFFORTS, Effort

__all__ = ["EFFORTS", "Effort", "effort_of"]
