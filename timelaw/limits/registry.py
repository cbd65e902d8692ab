"""The registry of limits, by the key they have in problem and law files."""

from collections.abc import Mapping, Sequence

import numpy as np

from timelaw.limits.bounds import Bounds
from timelaw.limits.limit import Limit, LimitKind
from timelaw.limits.momentum import Momentum
from timelaw.limits.rate import Rate
from timelaw.limits.row import Row
from timelaw.limits.torque import Torque
from timelaw.numerics.array import Array
from timelaw.units import ANGULAR_ACCELERATION, ANGULAR_JERK, ANGULAR_SNAP, ANGULAR_VELOCITY, MOMENTUM, TORQUE

LIMITS: dict[str, LimitKind] = {
    "velocity": LimitKind(ANGULAR_VELOCITY, lambda bounds, _: Rate("velocity", 1, bounds)),
    "acceleration": LimitKind(ANGULAR_ACCELERATION, lambda bounds, _: Rate("acceleration", 2, bounds)),
    "jerk": LimitKind(ANGULAR_JERK, lambda bounds, _: Rate("jerk", 3, bounds), continuity=2),
    "snap": LimitKind(
        ANGULAR_SNAP, lambda bounds, _: Rate("snap", 4, bounds), continuity=3, sufficient=False
    ),
    "torque": LimitKind(
        TORQUE, lambda bounds, inertia: Torque("torque", bounds, inertia), needs_inertia=True
    ),
    "momentum": LimitKind(
        MOMENTUM, lambda bounds, inertia: Momentum("momentum", bounds, inertia), needs_inertia=True
    ),
}


def make_limits(given: Mapping[str, Bounds], inertia: Array | None = None) -> tuple[Limit, ...]:
    """The limits that a problem or law file gives, in the order of the registry."""
    matrix = np.eye(3) if inertia is None else inertia
    return tuple(kind.make(given[name], matrix) for name, kind in LIMITS.items() if name in given)


def list_rows(limits: Sequence[Limit], axis: Array) -> tuple[Row, ...]:
    """All rows of the limits on a leg about `axis`."""
    return tuple(row for limit in limits for row in limit.on(axis))
