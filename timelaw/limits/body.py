"""The rigid body: its inertia, and whose torque turns it."""

from dataclasses import dataclass, field

import numpy as np

from timelaw.numerics.array import Array

EXTERNAL, WHEELS = "external", "wheels"


@dataclass(frozen=True)
class RigidBody:
    """`inertia` J (3, 3) [kg·m²] in body axes, and who turns the body: the `actuator`.

    A torque from outside (a robot's arm, thrusters, a rate table) is Jα + ω×Jω. Reaction wheels turn
    the body by changing their own momentum: the total H (3,) [N·m·s], body and wheels, stays what it
    is in the world, so their torque is Jα + ω×H and what they store is H - Jω. J is then without the
    wheels' inertia about their axes. `momentum` is H in body axes at t = 0.
    """

    inertia: Array
    actuator: str = EXTERNAL
    momentum: Array = field(default_factory=lambda: np.zeros(3))

    @property
    def total_momentum(self) -> float:
        """|H| [N·m·s]: the size stays, the direction in body axes turns as the body does."""
        return float(np.linalg.norm(self.momentum))
