"""`report.html`: one self-contained page, and the figures it shows as files of their own."""

import platform
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape
from markupsafe import Markup

from timelaw import __version__
from timelaw.certificate import NodeReport
from timelaw.certificate.continuity import JUMP_TOLERANCE
from timelaw.certificate.record import RECORD_TOLERANCE
from timelaw.nlp.exchange import GAP
from timelaw.objectives import OBJECTIVES
from timelaw.pipeline import Design
from timelaw.problem.objective import Goal
from timelaw.report.active_limits import list_active
from timelaw.report.figures.registry import draw_figures
from timelaw.report.summary import list_law_rows, list_run_rows
from timelaw.report.tour_text import describe_merits
from timelaw.requirements.route_limit import limit_route

PACKAGES = ("casadi", "numpy", "matplotlib")
RATES = (("omega", "ω", "deg/s"), ("alpha", "α", "deg/s²"), ("jerk", "jerk", "deg/s³"))


def render_report(design: Design, digest: str) -> dict[str, str]:
    """Texts by file name: report.html and its figures. `digest` is that of the problem file."""
    pictures = draw_figures(design)
    page = _environment().get_template("report.html").render(_context(design, digest, pictures))
    return {"report.html": page, **pictures}


def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("timelaw.report", "templates"),
        autoescape=select_autoescape(["html"]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["deg"] = np.degrees
    environment.filters["vector"] = _vector
    environment.filters["shown"] = _shown
    return environment


def _context(design: Design, digest: str, pictures: dict[str, str]) -> dict[str, Any]:
    rows = list_law_rows(design)
    return {
        "design": design,
        "problem": design.problem,
        "tour": design.tour,
        "certificate_lines": describe_merits(design.tour),
        "route": design.route,
        "rows": rows,
        "active": {s.name: list_active(design.optimised.law, s) for s in design.optimised.law.legs},
        "arcs": list(zip(design.route.legs, design.optimised.law.legs, design.solution.timings, strict=True)),
        "best": rows[0],
        "objective": _objective(design.problem.objective),
        "least": limit_route(design.route, design.requirements),
        "limits": [check.limit for check in design.optimised.certificate.limits],
        "runs": list_run_rows(design),
        "runs_count": len(design.requirements.runs(design.route)),
        "kinds": [_kinds(entry.certificate.continuity.nodes) for entry in design.laws],
        "rates": RATES,
        "scales": {
            entry.name: dict(zip([r[0] for r in RATES], entry.certificate.continuity.scales, strict=True))
            for entry in design.laws
        },
        "pictures": {name: Markup(text[text.index("<svg") :]) for name, text in pictures.items()},
        "digest": digest,
        "file": Path(design.path).name,
        "versions": {"timelaw": __version__, "Python": platform.python_version()}
        | {name: version(name) for name in PACKAGES},
        "tolerances": {"jump": JUMP_TOLERANCE, "gap": GAP, "record": RECORD_TOLERANCE},
    }


def _kinds(nodes: tuple[NodeReport, ...]) -> dict[str, float]:
    """The largest jump of each rate over all nodes of a law."""
    return {name: max(node.jump[name] for node in nodes) for name, _, _ in RATES}


def _objective(goal: Goal) -> str:
    """The objective in words."""
    objective = OBJECTIVES[goal.minimise]
    if not objective.takes:
        return f"least {objective.words}"
    if goal.total_time is None:
        return f"least time plus {goal.weight:g} times {goal.minimise}, each relative to the least-time law"
    unit = "times the least time" if goal.total_time.relative else "s"
    return f"least {objective.words} in a total time of {goal.total_time.value:g} {unit}"


def _shown(value: float, unit: str) -> str:
    """A bound or peak with its unit, angles in degrees."""
    if "rad" in unit:
        return f"{np.degrees(value):.6g} {unit.replace('rad', 'deg')}"
    return f"{value:.6g} {unit}"


def _vector(components: Any, scale: float) -> str:
    """Three components in degrees with a true minus sign, 0 where they are rounding against `scale`."""
    shown = [0.0 if abs(c) <= JUMP_TOLERANCE * scale else float(np.degrees(c)) for c in components]
    return ", ".join(f"{c:.5g}".replace("-", "−") for c in shown)
