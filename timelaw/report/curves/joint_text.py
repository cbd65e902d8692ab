"""What is to be said of the joints of curves: how smooth parameter and path are, and what the body does."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from timelaw.bezier.joints import Joint
from timelaw.errors import list_some
from timelaw.problem import Problem


def describe_joints(joints: Sequence[Joint], passed: Sequence[bool], problem: Problem) -> list[str]:
    """A sentence on all joints together, then one on each."""
    if not joints:
        return []
    found = [_describe_all(joints, passed)]
    found += [describe_joint(joint, goes, problem) for joint, goes in zip(joints, passed, strict=True)]
    return found


def _describe_all(joints: Sequence[Joint], passed: Sequence[bool]) -> str:
    least, path = min(j.parametric for j in joints), min(j.geometric for j in joints)
    stops = [joint.label for joint, goes in zip(joints, passed, strict=True) if not goes]
    joined = f"The given curves are joined C{least}{' only' if least == 0 else ''}, their path is G{path}"
    return f"{joined}; the body stops at {list_some(stops)}." if stops else f"{joined}; it stops at no joint."


def describe_joint(joint: Joint, goes: bool, problem: Problem) -> str:
    """What turns there, by how much, and whether the body goes on."""
    text = f"Joint {joint.label}: C{joint.parametric} in the given parameter, G{joint.geometric} in its path"
    turns = [
        f"{what} turns by {np.degrees(angle):.4g}°"
        for what, angle in (("the axis of rotation", joint.turn), ("the way of the origin", joint.bend))
        if angle is not None and (joint.geometric == 0 or angle > 0)
    ]
    if joint.geometric == 0 and turns:
        text += ": " + " and ".join(turns)
    elif joint.geometric == 1:
        kinks = [
            f"{size:.4g} {unit}"
            for size, unit in ((joint.curving, "per rad"), (joint.winding, "per m"))
            if size
        ]
        text += f": its curvature jumps by {' and '.join(kinks)}" if kinks else ""
    if goes:
        return f"{text}; the body passes."
    asked = joint.geometric >= problem.nodes.continuity and "; a stop or dwell is asked for"
    return f"{text}{asked or ''}; the body stops."


def list_joint_data(joints: Sequence[Joint], passed: Sequence[bool]) -> list[dict[str, Any]]:
    """Joints as plain data: rad and m, per unit of the curves' parameters."""
    return [
        {**asdict(joint), "geometric": joint.geometric, "passed": goes}
        for joint, goes in zip(joints, passed, strict=True)
    ]
