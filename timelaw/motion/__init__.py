"""The quaternion law: route and time law composed into the motion, evaluable at any instant."""

from timelaw.motion.arc import Arc
from timelaw.motion.dwell import Dwell
from timelaw.motion.quaternion_law import QuaternionLaw, Segment, compose

__all__ = ["Arc", "Dwell", "QuaternionLaw", "Segment", "compose"]
