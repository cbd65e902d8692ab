"""How the nonlinear programs were solved, run by run."""

from typing import Any

from timelaw.nlp.exchange import GAP
from timelaw.objectives import OBJECTIVES
from timelaw.problem.objective import Goal
from timelaw.report.section import Facts, Section
from timelaw.report.summary import list_run_rows


def _context(facts: Facts) -> dict[str, Any]:
    return {
        "objective": _describe(facts.design.problem.objective),
        "runs": list_run_rows(facts.design),
        "gap": GAP,
    }


def _describe(goal: Goal) -> str:
    """The objective in words."""
    objective = OBJECTIVES[goal.minimise]
    if not objective.takes:
        return f"least {objective.words}"
    if goal.total_time is None:
        return f"least time plus {goal.weight:g} times {goal.minimise}, each relative to the least-time law"
    unit = "times the least time" if goal.total_time.relative else "s"
    return f"least {objective.words} in a total time of {goal.total_time.value:g} {unit}"


SECTION = Section("How it was solved", "solved.html", _context, lambda design: design.through is None)
