"""Objectives: what the nonlinear program makes least."""

from timelaw.objectives.effort import EFFORTS, Effort
from timelaw.objectives.objective import Objective
from timelaw.objectives.registry import OBJECTIVES

__all__ = ["EFFORTS", "OBJECTIVES", "Effort", "Objective"]
