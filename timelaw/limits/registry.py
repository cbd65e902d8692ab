"""The registry of limits, by the key they have in problem and law files."""

from collections.abc import Mapping, Sequence

import numpy as np

from timelaw.limits.body import RigidBody
from timelaw.limits.bounds import Bounds
from timelaw.limits.formula import LINEAR, ZERO
from timelaw.limits.limit import Limit, LimitKind
from timelaw.limits.linear import LinearRate
from timelaw.limits.momentum import Momentum, find_contradiction
from timelaw.limits.rate import Rate
from timelaw.limits.row import ORDERS, FormulaRow, Row
from timelaw.limits.torque import ACTUATORS
from timelaw.numerics.array import Array
from timelaw.units import (
    ANGULAR_ACCELERATION,
    ANGULAR_JERK,
    ANGULAR_SNAP,
    ANGULAR_VELOCITY,
    LINEAR_ACCELERATION,
    LINEAR_VELOCITY,
    MOMENTUM,
    TORQUE,
)


def _limit_rate(name: str, bounds: Bounds) -> Rate:
    return Rate(name, ORDERS[name], bounds)


LIMITS: dict[str, LimitKind] = {
    "velocity": LimitKind(ANGULAR_VELOCITY, lambda bounds, _: _limit_rate("velocity", bounds)),
    "acceleration": LimitKind(
        ANGULAR_ACCELERATION, lambda bounds, _: _limit_rate("acceleration", bounds), smooths=1
    ),
    "jerk": LimitKind(ANGULAR_JERK, lambda bounds, _: _limit_rate("jerk", bounds), continuity=2, smooths=2),
    "snap": LimitKind(
        ANGULAR_SNAP, lambda bounds, _: _limit_rate("snap", bounds), continuity=3, sufficient=False
    ),
    "torque": LimitKind(
        TORQUE,
        lambda bounds, body: ACTUATORS[body.actuator]("torque", bounds, body),
        needs_inertia=True,
        smooths=1,
    ),
    "momentum": LimitKind(
        MOMENTUM,
        lambda bounds, body: Momentum("momentum", bounds, body),
        needs_inertia=True,
        contradiction=find_contradiction,
    ),
    "linear_velocity": LimitKind(
        LINEAR_VELOCITY, lambda bounds, _: LinearRate("linear_velocity", 1, bounds), needs_translation=True
    ),
    "linear_acceleration": LimitKind(
        LINEAR_ACCELERATION,
        lambda bounds, _: LinearRate("linear_acceleration", 2, bounds),
        needs_translation=True,
        smooths=1,
    ),
}
POINT = RigidBody(np.eye(3))  # for limits that ask for no body


def make_limits(given: Mapping[str, Bounds], body: RigidBody | None = None) -> tuple[Limit, ...]:
    """The limits that a problem or law file gives, in the order of the registry."""
    return tuple(kind.make(given[name], body or POINT) for name, kind in LIMITS.items() if name in given)


def list_formula_rows(limits: Sequence[Limit]) -> list[FormulaRow]:
    """The formulas of the limits as rows, in their order: labels and bounds, whatever the rates."""
    rates = dict.fromkeys([*ORDERS.values(), *LINEAR.values()], ZERO)
    return [
        FormulaRow(limit.name, f.label, limit.unit, f.bound, f.root, limit.highest)
        for limit in limits
        for f in limit.of(rates)
    ]


def list_rows(limits: Sequence[Limit], axis: Array) -> tuple[Row, ...]:
    """All rows of the limits on a leg about `axis`."""
    return tuple(row for limit in limits for row in limit.on(axis))
