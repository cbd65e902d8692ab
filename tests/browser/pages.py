"""Pages that hold the motion alone, and hand-made laws of many legs, made without a solver."""

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from timelaw.certificate import certify
from timelaw.easing import Profile
from timelaw.motion import QuaternionLaw
from timelaw.motion.arc import Arc
from timelaw.report.page import make_environment
from timelaw.report.sections.pictures import list_pictures
from timelaw.report.viewer.viewer import make_viewer

QUINTIC = (0.0, 0.0, 0.0, 1.0, 1.0, 1.0)  # control points of 6τ⁵ - 15τ⁴ + 10τ³
PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>motion</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
:root {{ --ink: #222; --paper: #fff; }}
@media (prefers-color-scheme: dark) {{ :root {{ --ink: #e8e8ea; --paper: #17181b; --line: #3a3b40; --muted: #a5a5ab; --accent: #7fb8ff; }} }}
:root {{ --axis-x: #b3261e; --axis-y: #1660b0; --axis-z: #1b6e3c; }}
@media (prefers-color-scheme: dark) {{ :root {{ --axis-x: #ff7f74; --axis-y: #6aaef7; --axis-z: #6cc98c; --grid: #3d3e44; }} }}
body {{ font: 15px/1.5 system-ui, sans-serif; margin: 1rem; color: var(--ink); background: var(--paper); }}
</style></head>
<body>{body}</body></html>
"""


def write_page(law: QuaternionLaw, path: Path, *, pictures: bool = False) -> Path:
    """A page with the law's motion, and with its pictures if asked."""
    environment = make_environment()
    body = environment.get_template("sections/motion.html").render(viewer=make_viewer(law, certify(law)))
    if pictures:
        body += environment.get_template("sections/pictures.html").render(views=list_pictures(law))
    path.write_text(PAGE.format(body=body), encoding="utf-8")
    return path


def make_law(legs: int, seed: int = 1) -> QuaternionLaw:
    """Random orientations one after the other, each leg another angle in another time, eased by the quintic."""
    rng = np.random.default_rng(seed)
    nodes = Rotation.random(legs + 1, rng=rng)
    easing, segments, time = Profile.single(QUINTIC), [], 0.0
    for k in range(legs):
        turn = (nodes[k].inv() * nodes[k + 1]).as_rotvec()
        angle = float(np.linalg.norm(turn))
        start, end = (nodes[i].as_quat(scalar_first=True) for i in (k, k + 1))
        duration = 2.0 + angle
        profile = easing.scaled(angle, duration)
        segments.append(Arc(str(k), str(k + 1), time, duration, start, end, turn / angle, angle, profile, {}))
        time = segments[-1].end_time
    return QuaternionLaw("random", tuple(segments), {"velocity": 3.0, "acceleration": 9.0, "jerk": 60.0})
