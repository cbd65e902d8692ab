"""Is it right to refuse a problem along Bézier curves? What its curves and limits show by themselves."""

import re

import numpy as np

from tests.campaign.curve_spec import measure_gap, read_curves
from tests.campaign.refusal import CONFIRMED, UNCONFIRMED, WRONG
from tests.campaign.spec import Spec, leg_limits

VANISHES = re.compile(
    r"route\.bezier\[(\d+)\]\.quaternions: the quaternion of the curve nearly vanishes at u = (\S+),"
)
BEGINS = re.compile(
    r"route\.bezier\[(\d+)\]\.\w+\[1\]: begins (\S+?)(°| m) from where the curve before it ends"
)
DEGREE = re.compile(r"easing\.degree: (\d+); on curve (\d+)–\d+ at most (\d+) is possible")
UNMOVED = re.compile(r"nothing that is limited moves on curve (\d+)–(\d+)")
ENDLESS = "no time is long enough"
LEAST_SQUARE, SAME_ORIENTATION, SAME_PLACE = 1e-4, 1e-6, 1e-6
NEAR = 0.01  # of these, within which neither side is wrong
MOST_CONTROL, MOST_POINTS = 64, 200
STILL = 1e-12
ASKED = {  # what is not to be had along curves, and whether a problem asks for it
    "a Bézier motion is made in least time": lambda spec: spec.objective["minimise"] != "time",
    "a Bézier motion begins and ends at rest": lambda spec: spec.moving,
    "the time of a curve cannot be given": lambda spec: any(
        "duration" in rule for rule in spec.legs.values()
    ),
    'only "dwell" and "stop" can be asked of a joint': lambda spec: any(
        "time" in rule or "limits" in rule for rule in spec.nodes.values()
    ),
}


def judge_curve_refusal(spec: Spec, message: str) -> tuple[str, str]:
    """Verdict, and what speaks for it."""
    for says, asks in ASKED.items():
        if says in message:
            return (CONFIRMED, "") if asks(spec) else (WRONG, "it was not asked for")
    curves = read_curves(spec.data)
    if found := VANISHES.search(message):
        thin = curves[int(found.group(1)) - 1].thinness
        return (
            (CONFIRMED, "")
            if thin < LEAST_SQUARE * (1 + NEAR)
            else (WRONG, f"|Q|² is at least {thin:.3g} of its largest")
        )
    if found := BEGINS.search(message):
        k = int(found.group(1)) - 1
        angle, gap = measure_gap(curves[k - 1], curves[k])
        off, least = (angle, SAME_ORIENTATION) if found.group(3) == "°" else (gap, SAME_PLACE)
        return (CONFIRMED, "") if off > least * (1 - NEAR) else (WRONG, f"they are {off:.3g} apart")
    if found := DEGREE.search(message):
        return _judge_degree(curves[int(found.group(2)) - 1], int(found.group(1)), int(found.group(3)))
    if found := UNMOVED.search(message):
        return _judge_unmoved(spec, curves, *found.groups())
    if ENDLESS in message or "leaves nothing" in message or "momentum" in message:
        return _judge_momentum(spec)
    return UNCONFIRMED, "no oracle knows this message"


def _judge_degree(curve, degree: int, most: int) -> tuple[str, str]:
    """Q∘f of degree nd has nd + 1 control points, P∘f or (P|Q|²)∘f alike."""
    n = len(curve.control) - 1
    m = 0 if curve.points is None else len(curve.points) - 1 + (0 if curve.divided else 2 * n)
    parts = [(MOST_CONTROL - 1) // n, *([(MOST_POINTS - 1) // m] if m else [])]
    if degree <= min(parts):
        return WRONG, f"{degree} is possible"
    return (
        (CONFIRMED, "") if most in parts and degree > most else (WRONG, f"at most {min(parts)} is possible")
    )


def _judge_unmoved(spec: Spec, curves, origin: str, target: str) -> tuple[str, str]:
    """Whether a curve only turns under limits on its origin, or only moves under limits on its turning."""
    turning, moving = curves[int(origin) - 1].lengths()
    names = {name for limits in leg_limits(spec, origin, target, (False, False)) for name in limits}
    linear = {name for name in names if name.startswith("linear")}
    limited = (turning > STILL and names - linear) or (moving > STILL and linear)
    return (WRONG, "something that is limited moves there") if limited else (CONFIRMED, "")


def _judge_momentum(spec: Spec) -> tuple[str, str]:
    """Wheels that hold more than they may at rest already."""
    body, bound = spec.body, spec.limits.get("momentum")
    if body is None or not np.any(body.momentum) or bound is None:
        return WRONG, "from rest to rest there is always a law"
    held = float(np.linalg.norm(body.momentum))
    if held > float(np.max(bound)):
        return CONFIRMED, ""
    return UNCONFIRMED, f"wheels hold {held:.6g} N·m·s"
