"""Every limit with its proved peak, and whose torque is meant."""

from typing import Any

from timelaw.limits.torque import TORQUE_FORMULAS
from timelaw.report.section import Facts, Section


def _context(facts: Facts) -> dict[str, Any]:
    checks = facts.design.optimised.certificate.limits
    notes = dict.fromkeys(f"{c.limit.split(' ')[0]}: {c.note}" for c in checks if c.note)
    body = facts.design.requirements.body
    return {"notes": list(notes), "body": "" if body is None else TORQUE_FORMULAS[body.actuator]}


SECTION = Section("Limits", "limits.html", _context)
