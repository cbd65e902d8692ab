"""Past the nodes: how the arcs are left, leg by leg, and what each rung of the search came to."""

from typing import Any

import numpy as np

from timelaw.report.active_limits import list_active
from timelaw.report.section import Facts, Section


def _context(facts: Facts) -> dict[str, Any]:
    design = facts.design
    law = design.optimised.law
    active = list_active(design.optimised.certificate)
    rows = []
    angles = facts.scene.deviations
    for index, (segment, edges, angle) in enumerate(zip(law.segments, law.edges, angles, strict=True)):
        if not segment.moves:
            continue
        speed = float(np.linalg.norm(edges.sides[0, -1]))
        rows.append((segment, angle, speed, active[index]))
    return {"rows": rows, "passages": design.through.passages if design.through else ()}


SECTION = Section("Past the nodes", "passing.html", _context, lambda design: design.through is not None)
