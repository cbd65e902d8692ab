"""Easings: functions f(τ) on [0, 1] from 0 to 1 that say how a leg is run through in its time."""

from timelaw.easing.profile import Profile
from timelaw.easing.timing import Timing

__all__ = ["Profile", "Timing"]
