"""Objectives: what the nonlinear program makes least."""

from timelaw.objectives.integral import effort_of
from timelaw.objectives.objective import EFFORTS, OBJECTIVES, Effort

__all__ = ["EFFORTS", "OBJECTIVES", "Effort", "effort_of"]
