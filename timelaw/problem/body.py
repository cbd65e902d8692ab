"""The parts of a problem file about the body: its limits and its inertia."""

from typing import Annotated, Any, Self

import numpy as np
from pydantic import BeforeValidator, model_validator

from timelaw.numerics.array import Array
from timelaw.problem.values import Model, bounds, fault, read_quantity
from timelaw.units import (
    ANGULAR_ACCELERATION,
    ANGULAR_JERK,
    ANGULAR_SNAP,
    ANGULAR_VELOCITY,
    INERTIA,
    MOMENTUM,
    MOST,
    TORQUE,
)

SYMMETRY_TOLERANCE = 1e-9  # of the largest moment: the two halves of a matrix are typed alike
Bounds = float | tuple[float, float, float]
Rows = tuple[tuple[float, float, float], ...]


class Limits(Model):
    """Bounds on the body's motion, each on a norm or on three body axes, each optional."""

    velocity: Annotated[Bounds | None, bounds(ANGULAR_VELOCITY)] = None
    acceleration: Annotated[Bounds | None, bounds(ANGULAR_ACCELERATION)] = None
    jerk: Annotated[Bounds | None, bounds(ANGULAR_JERK)] = None
    snap: Annotated[Bounds | None, bounds(ANGULAR_SNAP)] = None
    torque: Annotated[Bounds | None, bounds(TORQUE)] = None
    momentum: Annotated[Bounds | None, bounds(MOMENTUM)] = None

    @model_validator(mode="after")
    def _some(self) -> Self:
        if not self.given():
            raise fault(f"at least one of {', '.join(type(self).model_fields)} must be given")
        if list(self.given()) == ["snap"]:
            raise fault("snap alone is not enough; limit the velocity, acceleration, jerk or torque too")
        return self

    def given(self) -> dict[str, Bounds]:
        """The limits that are set, by name, in SI."""
        return {name: value for name, value in self if value is not None}


def _inertia(value: Any) -> Any:
    """Three principal moments, or three rows of three."""
    if not isinstance(value, list) or len(value) != 3:
        raise fault("three principal moments or three rows of three are needed")
    if all(isinstance(row, list) and len(row) == 3 for row in value):
        matrix = np.array(
            [[read_quantity(v, INERTIA, -MOST) if v != 0 else 0.0 for v in row] for row in value]
        )
    elif not any(isinstance(row, list) for row in value):
        matrix = np.diag([read_quantity(v, INERTIA) for v in value])
    else:
        raise fault("three principal moments or three rows of three are needed")
    return _possible(matrix)


def _moment(value: Any) -> float:
    """An entry of the matrix; a plain 0 needs no unit."""
    return 0.0 if value == 0 else read_quantity(value, INERTIA, -MOST)


def _possible(matrix: Array) -> Rows:
    """The matrix as rows, if a body can have it: symmetric, positive, moments as of a mass distribution."""
    if np.max(np.abs(matrix - matrix.T)) > SYMMETRY_TOLERANCE * np.max(np.abs(matrix)):
        raise fault("the inertia matrix is not symmetric")
    moments = np.linalg.eigvalsh((matrix + matrix.T) / 2)
    listing = ", ".join(f"{m:.6g}" for m in moments)
    if moments[0] <= 0:
        raise fault(f"the principal moments {listing} kg*m^2 must be positive")
    if moments[2] > (moments[0] + moments[1]) * (1 + SYMMETRY_TOLERANCE):
        message = f"no body has the moments {listing} kg*m^2: one is above the sum of the others"
        raise fault(message)
    return tuple((float(a), float(b), float(c)) for a, b, c in (matrix + matrix.T) / 2)


class Body(Model):
    """The rigid body: its inertia J in body axes [kg·m²], three principal moments or three rows."""

    inertia: Annotated[Rows, BeforeValidator(_inertia)]
