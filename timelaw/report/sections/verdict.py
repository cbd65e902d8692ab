"""What came of it, in three sentences: certified or not, how fast, how smooth."""

from typing import Any

from timelaw.pipeline import Design
from timelaw.report.outcome import describe_outcome
from timelaw.report.section import Facts, Section
from timelaw.report.tour_text import describe_moves, describe_order


def _context(facts: Facts) -> dict[str, Any]:
    design = facts.design
    return {
        "certificate_lines": [
            *describe_order(design.tour),
            *describe_moves(design.orientations, design.route),
        ],
        "passed": _count_passed(design),
        "best": facts.rows[0],
        "outcome": describe_outcome(design, facts.rows),
    }


def _count_passed(design: Design) -> int:
    """Inner nodes at which the body does not have to stop."""
    straight = len(design.route.legs) - len(design.requirements.runs(design.route))
    if design.through is None:
        return straight
    return sum(node.passed for node in design.optimised.certificate.continuity.nodes[1:-1])


SECTION = Section("", "verdict.html", _context)
