"""The part of a problem file about the body: its inertia."""

from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator

from timelaw.numerics.array import Array
from timelaw.problem.fields import Model, fault, read_quantity
from timelaw.units import INERTIA, MOST

SYMMETRY_TOLERANCE = 1e-9  # of the largest moment: the two halves of a matrix are typed alike
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
