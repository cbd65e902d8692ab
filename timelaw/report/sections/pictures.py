"""The motion at a glance: traces of the body axes, the body at the nodes, the route on S³."""

from typing import Any

from markupsafe import Markup

from timelaw.motion import QuaternionLaw
from timelaw.report.pictures.registry import PICTURES
from timelaw.report.pictures.render import embed_picture
from timelaw.report.section import Facts, Section

SHOWN = {
    "traces": "Where the body axes x, y and z point in the world over the whole motion, on the unit sphere; "
    "the far side is fainter [MMB2017, figure 2]. Where dots of equal steps of time stand apart it is fast.",
    "frames": "In the order in which the body visits them, with the time of each [MMB2017, figure 1].",
    "sphere": "The unit quaternions of the motion on S³, projected stereographically into space. Grey are "
    "the edges between the nodes that are nearest to each other, a quaternion and its opposite both shown.",
}


def list_pictures(law: QuaternionLaw) -> list[dict[str, Any]]:
    """Title, picture and caption of each."""
    return [
        {"title": PICTURES[name].title, "picture": Markup(embed_picture(law, name)), "caption": caption}
        for name, caption in SHOWN.items()
    ]


def _context(facts: Facts) -> dict[str, Any]:
    return {"views": list_pictures(facts.design.optimised.law)}


SECTION = Section("The motion in pictures", "pictures.html", _context)
