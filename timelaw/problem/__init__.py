"""The problem file: YAML text → a checked, frozen model. Everything a user can mistype ends here."""

from timelaw.problem.load import load_problem, parse_problem
from timelaw.problem.problem import Problem
from timelaw.problem.source import Source

__all__ = ["Problem", "Source", "load_problem", "parse_problem"]
