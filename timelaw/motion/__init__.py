"""The quaternion law: the motion in segments, evaluable at any instant."""

from timelaw.motion.quaternion_law import QuaternionLaw
from timelaw.motion.segment import Segment

__all__ = ["QuaternionLaw", "Segment"]
