"""A motion that ends on a multiple of a control cycle, by the exact stretch of time."""

from dataclasses import replace
from math import ceil

import numpy as np

from timelaw.motion.quaternion_law import QuaternionLaw
from timelaw.motion.segment import Segment

ON_GRID = 1e-9  # of a cycle; what is as near to a multiple is one, but for rounding


def refuse_cycle(law: QuaternionLaw) -> str:
    """Why a motion cannot be stretched; empty if it can."""
    for side, rates in (("begins", law.before), ("ends", law.after)):
        if any(np.any(rate) for rate in rates.values()):
            return f"the motion {side} moving: stretched in time it would not have the rates that are given"
    if not law.legs:
        return "nothing moves that could be stretched"
    return ""


def stretch_to_cycle(law: QuaternionLaw, cycle: float) -> QuaternionLaw:
    """The law whose duration is the next multiple of `cycle` [s]; all that moves is equally slower.

    Orientations and their order stay, dwells last as long as they did, rates fall.
    """
    target = max(ceil(law.duration / cycle - ON_GRID), 1) * cycle
    moving = sum(segment.duration for segment in law.legs)
    factor = 1 + (target - law.duration) / moving
    segments: list[Segment] = []
    start = 0.0
    for segment in law.segments:
        segments.append(segment.stretched(factor, start))
        start = segments[-1].end_time
    return replace(law, segments=tuple(segments))
