"""The part of a problem file about the body: its inertia, and who turns it."""

from typing import Annotated, Any, Self

import numpy as np
from pydantic import BeforeValidator, model_validator

from timelaw.limits.body import EXTERNAL, WHEELS, RigidBody, find_impossibility
from timelaw.limits.torque import ACTUATORS
from timelaw.numerics.array import Array
from timelaw.problem.fields import Model, fault, one_of, read_quantity
from timelaw.units import INERTIA, LENGTH, MOMENTUM, MOST

Rows = tuple[tuple[float, float, float], ...]


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


def _possible(matrix: Array) -> Rows:
    """The matrix as rows, if a body can have it."""
    reason = find_impossibility(matrix)
    if reason:
        raise fault(reason)
    return tuple((float(a), float(b), float(c)) for a, b, c in (matrix + matrix.T) / 2)


def _momentum(value: Any) -> Any:
    """Three components."""
    if not isinstance(value, list) or len(value) != 3:
        raise fault("three components in body axes are needed, as in [0 N*m*s, 0 N*m*s, 0.2 N*m*s]")
    return tuple(0.0 if v == 0 else read_quantity(v, MOMENTUM, -MOST) for v in value)


def _shape(value: Any) -> Any:
    """Three edges."""
    if not isinstance(value, list) or len(value) != 3:
        raise fault("three edges of a box along the body axes are needed, as in [1 m, 1.5 m, 2 m]")
    return tuple(read_quantity(v, LENGTH) for v in value)


class Body(Model):
    """The rigid body: its inertia J in body axes [kg·m²], three principal moments or three rows.

    `shape` are the edges of the box that pictures show.

    `actuator: wheels` means that reaction wheels turn it: J is then without the wheels' inertia about
    their axes, and `momentum` the total H of body and wheels in body axes at t = 0.
    """

    inertia: Annotated[Rows | None, BeforeValidator(_inertia)] = None
    actuator: Annotated[str, one_of(ACTUATORS)] = EXTERNAL
    momentum: Annotated[tuple[float, float, float], BeforeValidator(_momentum)] = (0.0, 0.0, 0.0)
    shape: Annotated[tuple[float, float, float] | None, BeforeValidator(_shape)] = None

    @model_validator(mode="after")
    def _known(self) -> Self:
        if self.inertia is None and (self.shape is None or self.model_fields_set - {"shape"}):
            raise fault('missing key "inertia"')
        return self

    @model_validator(mode="after")
    def _momentum_is_the_wheels(self) -> Self:
        if "momentum" in self.model_fields_set and self.actuator != WHEELS:
            raise fault(f'it belongs to "actuator: {WHEELS}"', "momentum")
        return self

    def rigid_body(self) -> RigidBody | None:
        """As limits need it, if the inertia is given."""
        if self.inertia is None:
            return None
        return RigidBody(np.array(self.inertia), self.actuator, np.array(self.momentum))
