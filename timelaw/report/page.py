"""`report.html`: one self-contained page, and the figures it shows as files of their own."""

import re
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape
from markupsafe import Markup

from timelaw.certificate.jump_scale import JUMP_TOLERANCE
from timelaw.pipeline import Design
from timelaw.report.figures.drawing import Drawing
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.embed import describe_picture, inline_picture
from timelaw.report.figures.registry import FIGURES, draw_figures
from timelaw.report.section import Facts, Inline, Section
from timelaw.report.sections import SECTIONS
from timelaw.units import convert, name_unit


def render_report(design: Design, digest: str) -> dict[str, str]:
    """Texts by file name: report.html and its figures. `digest` is that of the problem file."""
    scene = Scene(design)
    drawings = draw_figures(scene, FIGURES)
    facts = Facts(design, digest, scene, embed_pictures(drawings))
    environment = make_environment()
    sections = [
        (section.title, section.key, _render_body(environment, section, facts))
        for section in SECTIONS
        if section.applies(design)
    ]
    page = render_page(environment, f"{design.problem.name}: timelaw report", sections)
    return {"report.html": page, **list_picture_files(drawings)}


def render_page(environment: Environment, title: str, sections: Sequence[tuple[str, str, Markup]]) -> str:
    """The whole page of sections: title, key, body; the contents follow the first, which has no title."""
    listed = [{"title": name, "key": key, "body": body} for name, key, body in sections]
    return environment.get_template("report.html").render(title=title, sections=listed)


def embed_pictures(drawings: Mapping[str, Drawing]) -> dict[str, Inline]:
    """Pictures for the page, by file name."""
    found = {}
    for name, drawing in drawings.items():
        sizes = {}
        for size, svg in (("wide", drawing.wide), ("narrow", drawing.narrow)):
            key = f"{name.removesuffix('.svg')}-{size}"
            told = describe_picture(svg, key, drawing.title, drawing.description)
            sizes[size] = Markup(inline_picture(told, key))
        found[name] = Inline(**sizes)
    return found


def list_picture_files(drawings: Mapping[str, Drawing]) -> dict[str, str]:
    """Pictures as files of their own, by name."""
    return {
        name: describe_picture(drawing.wide, name.removesuffix(".svg"), drawing.title, drawing.description)
        for name, drawing in drawings.items()
    }


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
    environment.filters["shown"] = show_quantity
    environment.filters["direction"] = _direction
    return environment


def show_quantity(value: float, unit: str) -> str:
    """A bound or peak with its unit, angles in degrees."""
    return f"{convert(value, unit, degrees=True):.6g} {name_unit(unit, degrees=True)}"


def _prose(text: str) -> Markup:
    """A sentence of ours as text of the page; what it quotes is escaped, apostrophes stay.

    Numbers keep their units on their line, and integrals stay whole.
    """
    kept = re.sub(r"(?<=\d) (?=(?:s|%|deg|rad|N·m|kg|m)(?:\W|[²³⁴]|$))", "\u00a0", text)
    integral = r'<span class="whole">\g<0></span>'
    return Markup(re.sub(r"∫\|[^|]+\|² dt", integral, escape(kept, quote=False)))


def _vector(components: Any, scale: float) -> str:
    """Three components in degrees with a true minus sign, 0 where they are rounding against `scale`."""
    shown = [0.0 if abs(c) <= JUMP_TOLERANCE * scale else float(np.degrees(c)) for c in components]
    return ", ".join(f"{c:.5g}".replace("-", "−") for c in shown)


def _direction(axis: Any) -> str:
    """A unit vector to four digits, with a true minus sign and no negative zero."""
    return ", ".join(f"{round(float(c), 4) + 0.0:.4f}".replace("-", "−") for c in axis)
