"""`report.html` of a motion along curves: one self-contained page, and the figures it shows."""

from types import SimpleNamespace
from typing import Any

from markupsafe import Markup

from timelaw.certificate.continuity import JUMP_TOLERANCE
from timelaw.limits.torque import TORQUE_FORMULAS
from timelaw.pipeline_bezier import BezierDesign
from timelaw.report.curves.joint_text import describe_joints
from timelaw.report.curves.outcome import describe_curves, describe_search, list_curve_rows
from timelaw.report.figures.box import INSTANTS, draw_box
from timelaw.report.figures.curve_easings import draw_curve_easings
from timelaw.report.figures.rates import draw_rates
from timelaw.report.figures.style import STYLE
from timelaw.report.page import make_environment
from timelaw.report.section import RATES
from timelaw.report.sections.continuity import largest_jumps
from timelaw.report.sections.provenance import list_versions

SECTIONS = (
    ("", "curves/verdict.html"),
    ("Laws side by side", "curves/laws.html"),
    ("The motion", "curves/motion.html"),
    ("Rates over time", "sections/rates.html"),
    ("Limits", "sections/limits.html"),
    ("Joints of the curves", "curves/joints.html"),
    ("Easings and durations", "curves/easings.html"),
    ("Continuity at the nodes", "sections/continuity.html"),
    ("The way of the origin", "curves/translation.html"),
    ("How it was solved", "curves/solved.html"),
    ("Checks of the geometry", "sections/geometry.html"),
    ("Provenance", "curves/provenance.html"),
)


def render_curve_report(design: BezierDesign, digest: str) -> dict[str, str]:
    """Texts by file name: report.html and its figures. `digest` is that of the problem file."""
    pictures = draw_pictures(design)
    inline = {name: Markup(text[text.index("<svg") :]) for name, text in pictures.items()}
    environment, context = make_environment(), _context(design, digest, inline)
    sections = []
    for title, template in SECTIONS:
        body = Markup(environment.get_template(template).render(**context)).strip()
        if body:
            sections.append({"title": title, "body": body})
    page = environment.get_template("report.html").render(problem=design.problem, sections=sections)
    return {"report.html": page, **pictures}


def draw_pictures(design: BezierDesign) -> dict[str, str]:
    """SVG texts by file name."""
    import matplotlib as mpl

    law = design.optimised.law
    with mpl.rc_context(STYLE):
        found = {"rates.svg": draw_rates(design), "easings.svg": draw_curve_easings(design)}
    return found | ({"motion.svg": draw_box(law)} if law.shape is not None else {})


def _context(design: BezierDesign, digest: str, pictures: dict[str, Markup]) -> dict[str, Any]:
    """What all templates draw from."""
    certificate, laws = design.optimised.certificate, design.laws
    body = design.problem.rigid_body()
    names = [rate[0] for rate in RATES]
    return {
        "design": design,
        "problem": design.problem,
        "certificate": certificate,
        "pictures": pictures,
        "route": SimpleNamespace(legs=design.curves, moved={}),
        "rows": list_curve_rows(design),
        "limits": [check.limit for check in certificate.limits],
        "outcome": describe_curves(design),
        "joint_lines": describe_joints(design.joints, design.passed, design.problem),
        "joints": list(zip(design.joints, design.passed, strict=True)),
        "search": describe_search(design),
        "instants": INSTANTS,
        "notes": list(
            dict.fromkeys(f"{c.limit.split(' ')[0]}: {c.note}" for c in certificate.limits if c.note)
        ),
        "body": "" if body is None else TORQUE_FORMULAS[body.actuator],
        "largest_jumps": [largest_jumps(entry.certificate.continuity.nodes) for entry in laws],
        "rates": RATES,
        "scales": {
            entry.name: dict(zip(names, entry.certificate.continuity.peaks.values(), strict=False))
            for entry in laws
        },
        "jump_tolerance": JUMP_TOLERANCE,
        "digest": digest,
        "file": design.path.name,
        "versions": list_versions(),
    }
