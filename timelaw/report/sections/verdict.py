"""What came of it, in three sentences: certified or not, how fast, how smooth."""

from typing import Any

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
        "runs_count": len(design.requirements.runs(design.route)),
        "best": facts.rows[0],
        "outcome": describe_outcome(design, facts.rows),
    }


SECTION = Section("", "verdict.html", _context)
