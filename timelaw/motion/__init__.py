"""The quaternion law: route and time law composed into the motion, evaluable at any instant."""

from timelaw.motion.arc import Arc
from timelaw.motion.quaternion_law import QuaternionLaw, compose

__all__ = ["Arc", "QuaternionLaw", "compose"]
