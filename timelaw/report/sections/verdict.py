"""What came of it at a glance: certified or not, what was gained, and how smooth it is."""

from typing import Any

from timelaw.pipeline import Design
from timelaw.report.headline import list_tiles
from timelaw.report.outcome import describe_outcome
from timelaw.report.problem_text import CONTINUOUS
from timelaw.report.section import Facts, Section


def _context(facts: Facts) -> dict[str, Any]:
    design = facts.design
    best = facts.rows[0]
    return {
        "passed": _count_passed(design),
        "best": best,
        "tiles": list_tiles(design, facts.rows),
        "continuous": CONTINUOUS[best.continuity],
        "outcome": describe_outcome(design, facts.rows),
    }


def _count_passed(design: Design) -> int:
    """Inner nodes at which the body does not have to stop."""
    straight = len(design.route.legs) - len(design.requirements.runs(design.route))
    if design.through is None:
        return straight
    return sum(node.passed for node in design.optimised.certificate.continuity.nodes[1:-1])


SECTION = Section("", "verdict.html", _context)
