"""The pictures of the rates over time."""

from typing import Any

from timelaw.report.figures.time_scale import TimeScale
from timelaw.report.figures.window import choose_window, is_long, name_window
from timelaw.report.section import Facts, Section


def _context(facts: Facts) -> dict[str, Any]:
    return describe_pictures(facts.design.optimised)


def describe_pictures(optimised: Any) -> dict[str, Any]:
    """What the captions of pictures over time say of a certified law."""
    law = optimised.law
    window = choose_window(law, optimised.certificate)
    return {
        "long": is_long(law),
        "part": name_window(law, window),
        "shortened": bool(TimeScale(law.segments).shortened),
        "rests": len(law.legs) < len(law.segments),
        "by_axis": any(isinstance(b, tuple) for s in (law, *law.segments) for b in s.limits.values()),
        "passes": any(node.passed for node in optimised.certificate.continuity.nodes),
    }


SECTION = Section("Rates over time", "rates.html", _context)
