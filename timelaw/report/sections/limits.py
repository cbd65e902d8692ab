"""Where the limits bind: every limit with its proved peak, and whose torque is meant."""

from typing import Any

from timelaw.limits.torque import TORQUE_FORMULAS
from timelaw.report.section import Facts, Section
from timelaw.report.sections.rates import describe_pictures


def _context(facts: Facts) -> dict[str, Any]:
    checks = facts.design.optimised.certificate.limits
    notes = dict.fromkeys(f"{c.limit.split(' ')[0]}: {c.note}" for c in checks if c.note)
    body = facts.design.requirements.body
    formula = "" if body is None else TORQUE_FORMULAS[body.actuator]
    return {"notes": list(notes), "body": formula, **describe_pictures(facts.design.optimised)}


SECTION = Section("Where the limits bind", "limits.html", _context)
