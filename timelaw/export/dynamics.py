"""The torque that turns the body along a law, and the momentum that it or its wheels hold."""

import numpy as np

from timelaw.limits.body import WHEELS, RigidBody
from timelaw.limits.formula import Rates, Vector
from timelaw.limits.momentum import Momentum
from timelaw.limits.torque import ACTUATORS
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import rotation_matrix


def measure_torque(law: QuaternionLaw, t: Array) -> Array:
    """Jα + ω×Jω from outside, Jα + ω×H of wheels, (m, 3) [N·m] in body axes at t (m,).

    Raises:
        ValueError: the law has no inertia.
    """
    body = _need_body(law)
    limit = ACTUATORS[body.actuator]("torque", 1.0, body)
    rates: Rates = {order: list(law(t, order).T) for order in (1, 2)}
    return np.stack(np.broadcast_arrays(*limit.vector(rates, _turn_total(law, t))), axis=-1)


def measure_momentum(law: QuaternionLaw, t: Array) -> Array:
    """Jω of a body turned from outside, H - Jω that its wheels store, (m, 3) [N·m·s] in body axes at t (m,).

    Raises:
        ValueError: the law has no inertia.
    """
    body = _need_body(law)
    stored = Momentum("momentum", 1.0, body).vector({1: list(law(t, 1).T)}, _turn_total(law, t))
    values = np.stack(np.broadcast_arrays(*stored), axis=-1)
    return values if body.actuator == WHEELS else -values


def _need_body(law: QuaternionLaw) -> RigidBody:
    if law.body is None:
        raise ValueError("the law has no inertia")
    return law.body


def _turn_total(law: QuaternionLaw, t: Array) -> Vector:
    """H (3, m) in body axes: what stays in the world is Rᵀ(t) R(0) of what it is at t = 0."""
    start = rotation_matrix(law(np.zeros(1))[0]) @ _need_body(law).momentum
    return list((law.direction_cosines(t) @ start).T)
