"""The easings, and leg by leg durations and active limits."""

from typing import Any

from timelaw.report.active_limits import list_active
from timelaw.report.section import Facts, Section


def _context(facts: Facts) -> dict[str, Any]:
    design = facts.design
    law, timings = design.optimised.law, design.solution.timings
    return {
        "active": {leg.name: list_active(law, leg) for leg in law.legs},
        "arcs": list(zip(design.route.legs, law.legs, timings, strict=True)),
    }


SECTION = Section("Easings and durations", "easings.html", _context)
