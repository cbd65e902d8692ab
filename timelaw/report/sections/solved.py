"""How the nonlinear programs were solved, one row for each distinct solution."""

from typing import Any

from timelaw.nlp.solution import GAP
from timelaw.report.section import FOLDED, Facts, Section
from timelaw.report.summary import join_alike, list_run_rows


def _context(facts: Facts) -> dict[str, Any]:
    runs = join_alike(list_run_rows(facts.design))
    return {"runs": runs, "gap": GAP, "folded": len(runs) > FOLDED}


SECTION = Section("How it was solved", "solved.html", _context, lambda design: design.through is None)
