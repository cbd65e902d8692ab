"""Ruckig, community version: jerk-limited laws of axes, from state to state."""

from functools import partial
from typing import Any

import numpy as np

from timelaw.errors import Fault, InfeasibleError
from timelaw.numerics.array import Array
from timelaw.reproduce.benchmarks.peers.arcs import Profile, follow_arcs
from timelaw.reproduce.benchmarks.peers.motion import Course, Motion, Peer

SETUP = (
    "one axis, the angle along the arc, from rest to rest under |φ'|, |φ''|, |φ'''|: the double-S itself. "
    "Limits of axes only, no norms; waypoints between are sent to a service by the community version, "
    "so that it cannot go past a corner"
)


def solve_angle(limits: tuple[float, float, float], angle: float) -> Profile:
    """The fastest law of one angle from rest to rest."""
    import ruckig

    asked = ruckig.InputParameter(1)
    asked.current_position, asked.target_position = [0.0], [angle]
    asked.max_velocity, asked.max_acceleration, asked.max_jerk = ([limit] for limit in limits)
    found = ruckig.Trajectory(1)
    if ruckig.Ruckig(1).calculate(asked, found) != ruckig.Result.Working:
        raise InfeasibleError(Fault("no trajectory", "ruckig"))
    return Profile(found.duration, partial(_evaluate, found))


def _evaluate(found: Any, t: Array) -> Array:
    return np.array([found.at_time(float(instant))[0][0] for instant in t])


def _go(course: Course, *, merged: bool) -> Motion:
    return follow_arcs(course, partial(solve_angle, course.limits), merged=merged)


PEERS = (
    Peer("Ruckig, leg by leg", "ruckig", SETUP, lambda course: partial(_go, course, merged=False)),
    Peer(
        "Ruckig, run by run",
        "ruckig",
        "the same, legs about one axis put together first",
        lambda course: partial(_go, course, merged=True),
    ),
)
