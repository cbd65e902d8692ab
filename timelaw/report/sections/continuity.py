"""The nodes of every law: which rates jump there, and by how much."""

from typing import Any

from timelaw.certificate import NodeReport
from timelaw.certificate.jump_scale import JUMP_TOLERANCE
from timelaw.report.section import RATES, Facts, Section


def _context(facts: Facts) -> dict[str, Any]:
    laws = facts.design.laws
    return {
        "largest_jumps": [largest_jumps(entry.certificate.continuity.nodes) for entry in laws],
        "rates": RATES,
        "scales": {
            entry.name: dict(
                zip([r[0] for r in RATES], entry.certificate.continuity.peaks.values(), strict=False)
            )
            for entry in laws
        },
        "jump_tolerance": JUMP_TOLERANCE,
    }


def largest_jumps(nodes: tuple[NodeReport, ...]) -> dict[str, float]:
    """The largest jump of each rate over all nodes of a law."""
    return {name: max(node.jump[name] for node in nodes) for name, _, _ in RATES}


SECTION = Section("Nodes and continuity", "continuity.html", _context)
