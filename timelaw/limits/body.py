"""The rigid body: its inertia, and whose torque turns it."""

from dataclasses import dataclass, field

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.ball import Ball, make_ball

EXTERNAL, WHEELS = "external", "wheels"

SYMMETRY_TOLERANCE = 1e-9  # of the largest moment: the two halves of a matrix are typed alike


def find_impossibility(inertia: Array) -> str:
    """Why no body has an inertia matrix (3, 3); empty if one can have it.

    It is symmetric, its principal moments are positive, and none is above the sum of the others.
    """
    if np.max(np.abs(inertia - inertia.T)) > SYMMETRY_TOLERANCE * np.max(np.abs(inertia)):
        return "the inertia matrix is not symmetric"
    moments = np.linalg.eigvalsh((inertia + inertia.T) / 2)
    listing = ", ".join(f"{m:.6g}" for m in moments)
    if not moments[0] > 0:
        return f"the principal moments {listing} kg*m^2 must be positive"
    if moments[2] > (moments[0] + moments[1]) * (1 + SYMMETRY_TOLERANCE):
        return f"no body has the moments {listing} kg*m^2: one is above the sum of the others"
    return ""


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
        """|H| [N·m·s], rounded up: the size stays, the direction in body axes turns as the body does."""
        squares = sum(component * component for component in map(Ball, self.momentum.tolist()))
        return make_ball(squares).sqrt().upper
