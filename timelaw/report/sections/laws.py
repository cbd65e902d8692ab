"""The optimised law beside the baselines."""

from typing import Any

from timelaw.report.section import Facts, Section


def _context(facts: Facts) -> dict[str, Any]:
    limits = [check.limit for check in facts.design.optimised.certificate.limits]
    return {"rows": facts.rows, "limits": limits}


SECTION = Section("Laws side by side", "laws.html", _context)
