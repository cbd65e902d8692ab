"""The nonlinear program: durations and easing coefficients of each run under the limits."""

from timelaw.nlp.optimiser import optimise
from timelaw.nlp.program import Program, RunProblem
from timelaw.nlp.solution import Solution, Status, Timings

__all__ = ["Program", "RunProblem", "Solution", "Status", "Timings", "optimise"]
