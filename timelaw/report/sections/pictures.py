"""The motion at a glance: traces of the body axes, the body at the nodes, the route on S³."""

from typing import Any

from markupsafe import Markup

from timelaw.motion import QuaternionLaw
from timelaw.report.pictures.registry import PICTURES
from timelaw.report.pictures.render import embed_picture
from timelaw.report.pictures.three_sphere import WHOLE, list_vertices
from timelaw.report.section import Facts, Section

TRACES = (
    "Where the body axes x, y and z point in the world over the whole motion, on the unit sphere; the far "
    "side is fainter [MMB2017, figure 2]. Where dots of equal steps of time stand apart it is fast."
)
FRAMES = "In the order in which the body visits them, with the time of each [MMB2017, figure 1]."
SPHERE = (
    "The unit quaternions of the motion on S³, projected stereographically into space. Grey are the edges "
    "between nodes that are nearest to each other"
)
WHOLE_SPHERE = "; a quaternion and its opposite, which is the same orientation, are both shown."
HALF_SPHERE = (
    ". Shown is the half about the first orientation, in a ball that has each orientation once: what leaves "
    "it comes back on the opposite side."
)


def list_pictures(law: QuaternionLaw) -> list[dict[str, Any]]:
    """Title, picture and caption of each."""
    captions = {
        "traces": TRACES,
        "frames": FRAMES,
        "sphere": SPHERE + (HALF_SPHERE if len(list_vertices(law)) > WHOLE else WHOLE_SPHERE),
    }
    return [
        {"title": PICTURES[name].title, "picture": Markup(embed_picture(law, name)), "caption": caption}
        for name, caption in captions.items()
    ]


def _context(facts: Facts) -> dict[str, Any]:
    return {"views": list_pictures(facts.design.optimised.law)}


SECTION = Section("The motion in pictures", "pictures.html", _context)
