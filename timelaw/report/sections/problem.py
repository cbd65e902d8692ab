"""The problem in words, with the terms that the page uses."""

from typing import Any

from timelaw.report.problem_text import describe_problem
from timelaw.report.section import Facts, Section
from timelaw.report.tour_text import describe_moves, describe_order


def _context(facts: Facts) -> dict[str, Any]:
    design = facts.design
    kinds = [node.kind for node in design.route.nodes[1:-1]]
    return {
        "order_lines": [
            *describe_order(design.tour),
            *design.orientations.notes,
            *describe_moves(design.orientations, design.route),
        ],
        "straight": kinds.count("straight"),
        "runs": len(design.requirements.runs(design.route)),
        "asked": describe_problem(design.problem),
    }


SECTION = Section("The problem", "problem.html", _context)
