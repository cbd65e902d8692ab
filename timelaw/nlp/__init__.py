"""The nonlinear program: durations and easing coefficients of each run under the limits."""

from timelaw.nlp.optimise import Optimised, optimise
from timelaw.nlp.run_problem import RunProblem, RunSolution, Status

__all__ = ["Optimised", "RunProblem", "RunSolution", "Status", "optimise"]
