"""The nonlinear program: durations and easing coefficients of each run under the limits."""

from timelaw.nlp.optimise import Optimised, optimise
from timelaw.nlp.program import Budget, Program, RunProblem, Solution, Status

__all__ = ["Budget", "Optimised", "Program", "RunProblem", "Solution", "Status", "optimise"]
