"""`report.html` of a motion along curves: one self-contained page, and the figures it shows."""

from types import SimpleNamespace
from typing import Any

from markupsafe import Markup

from timelaw.certificate.jump_scale import JUMP_TOLERANCE
from timelaw.limits.torque import TORQUE_FORMULAS
from timelaw.pipeline_bezier import BezierDesign
from timelaw.report.curves.joint_text import describe_joints
from timelaw.report.curves.outcome import describe_curves, describe_search, list_curve_rows, list_curve_tiles
from timelaw.report.figures.box import INSTANTS
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.registry import CURVE_FIGURES, draw_figures
from timelaw.report.page import embed_pictures, list_picture_files, make_environment, render_page
from timelaw.report.problem_text import CONTINUOUS, describe_problem
from timelaw.report.section import RATES, Inline
from timelaw.report.sections.continuity import largest_jumps
from timelaw.report.sections.pictures import list_pictures
from timelaw.report.sections.provenance import list_versions
from timelaw.report.sections.rates import describe_pictures
from timelaw.report.viewer.viewer import make_viewer

SECTIONS = (
    ("", "curves/verdict.html"),
    ("The problem", "curves/problem.html"),
    ("Laws side by side", "curves/laws.html"),
    ("The motion", "sections/motion.html"),
    ("The motion in pictures", "sections/pictures.html"),
    ("The motion at instants", "curves/instants.html"),
    ("Rates over time", "sections/rates.html"),
    ("Where the limits bind", "sections/limits.html"),
    ("Joints of the curves", "curves/joints.html"),
    ("Easings and durations", "curves/easings.html"),
    ("Nodes and continuity", "sections/continuity.html"),
    ("The way of the origin", "curves/translation.html"),
    ("How it was solved", "curves/solved.html"),
    ("What is proved, and what is not promised", "sections/promise.html"),
    ("Provenance", "curves/provenance.html"),
)


def render_curve_report(design: BezierDesign, digest: str) -> dict[str, str]:
    """Texts by file name: report.html and its figures. `digest` is that of the problem file."""
    drawings = draw_figures(Scene(design), CURVE_FIGURES)
    environment = make_environment()
    context = _context(design, digest, embed_pictures(drawings))
    sections = []
    for title, template in SECTIONS:
        body = Markup(environment.get_template(template).render(**context).strip())
        if body:
            sections.append((title, template.removesuffix(".html").split("/")[-1], body))
    page = render_page(environment, f"{design.problem.name}: timelaw report", sections)
    return {"report.html": page, **list_picture_files(drawings)}


def _context(design: BezierDesign, digest: str, pictures: dict[str, Inline]) -> dict[str, Any]:
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
        "tiles": list_curve_tiles(design),
        "continuous": CONTINUOUS[certificate.order],
        "asked": describe_problem(design.problem),
        **describe_pictures(design.optimised),
        "joint_lines": describe_joints(design.joints, design.passed, design.problem),
        "joints": list(zip(design.joints, design.passed, strict=True)),
        "search": describe_search(design),
        "instants": INSTANTS,
        "viewer": make_viewer(design.optimised.law, certificate),
        "views": list_pictures(design.optimised.law),
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
