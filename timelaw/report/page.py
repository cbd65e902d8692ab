"""`report.html`: one self-contained page, and the figures it shows as files of their own."""

from html import escape
from typing import Any

import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape
from markupsafe import Markup

from timelaw.certificate.continuity import JUMP_TOLERANCE
from timelaw.pipeline import Design
from timelaw.report.figures.registry import draw_figures
from timelaw.report.section import Facts, Section
from timelaw.report.sections import SECTIONS
from timelaw.units import convert, name_unit


def render_report(design: Design, digest: str) -> dict[str, str]:
    """Texts by file name: report.html and its figures. `digest` is that of the problem file."""
    pictures = draw_figures(design)
    facts = Facts(
        design, digest, {name: Markup(text[text.index("<svg") :]) for name, text in pictures.items()}
    )
    environment = make_environment()
    sections = [
        {"title": section.title, "body": _render_body(environment, section, facts)}
        for section in SECTIONS
        if section.applies(design)
    ]
    page = environment.get_template("report.html").render(problem=design.problem, sections=sections)
    return {"report.html": page, **pictures}


def _render_body(environment: Environment, section: Section, facts: Facts) -> Markup:
    """A section's template, filled; what it holds is escaped already."""
    design = facts.design
    common = {
        "design": design,
        "problem": design.problem,
        "tour": design.tour,
        "route": design.route,
        "certificate": design.optimised.certificate,
        "pictures": facts.pictures,
    }
    template = environment.get_template(f"sections/{section.template}")
    return Markup(template.render(**common, **section.context(facts)))


def make_environment() -> Environment:
    """Templates with everything escaped, and our filters."""
    environment = Environment(
        loader=PackageLoader("timelaw.report", "templates"),
        autoescape=select_autoescape(["html"]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["deg"] = np.degrees
    environment.filters["vector"] = _vector
    environment.filters["prose"] = _prose
    environment.filters["shown"] = _shown
    return environment


def _shown(value: float, unit: str) -> str:
    """A bound or peak with its unit, angles in degrees."""
    return f"{convert(value, unit, degrees=True):.6g} {name_unit(unit, degrees=True)}"


def _prose(text: str) -> Markup:
    """A sentence of ours as text of the page; what it quotes is escaped, apostrophes stay."""
    return Markup(escape(text, quote=False))


def _vector(components: Any, scale: float) -> str:
    """Three components in degrees with a true minus sign, 0 where they are rounding against `scale`."""
    shown = [0.0 if abs(c) <= JUMP_TOLERANCE * scale else float(np.degrees(c)) for c in components]
    return ", ".join(f"{c:.5g}".replace("-", "−") for c in shown)
