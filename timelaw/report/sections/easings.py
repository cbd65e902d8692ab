"""The easings, and leg by leg durations and active limits."""

from typing import Any

from timelaw.report.active_limits import list_active
from timelaw.report.section import Facts, Section


def _context(facts: Facts) -> dict[str, Any]:
    design = facts.design
    law, timings = design.optimised.law, design.solution.timings
    active = list_active(design.optimised.certificate)
    moving = [active[index] for index, segment in enumerate(law.segments) if segment.moves]
    return {"arcs": list(zip(design.route.legs, law.legs, timings, moving, strict=True))}


SECTION = Section("Easings and durations", "easings.html", _context, lambda design: design.through is None)
