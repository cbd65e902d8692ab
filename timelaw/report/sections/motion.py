"""The motion in the page: a body that one can turn and play."""

from typing import Any

from timelaw.report.section import Facts, Section
from timelaw.report.viewer.viewer import make_viewer


def _context(facts: Facts) -> dict[str, Any]:
    optimised = facts.design.optimised
    return {"viewer": make_viewer(optimised.law, optimised.certificate)}


SECTION = Section("The motion", "motion.html", _context)
