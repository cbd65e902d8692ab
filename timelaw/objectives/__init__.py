"""Objectives: what the nonlinear program makes least."""

from timelaw.objectives.objective import OBJECTIVES, Objective

__all__ = ["OBJECTIVES", "Objective"]
