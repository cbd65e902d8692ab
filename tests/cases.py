"""What several tests need: reference designs (each made once) and random problems."""

from functools import cache
from pathlib import Path

import numpy as np

from timelaw import design
from timelaw.limits import Demand, drop_implied, list_rows, make_limits
from timelaw.limits.body import RigidBody
from timelaw.limits.torque import make_torque_row
from timelaw.problem import parse_problem

PROBLEMS = Path(__file__).parent.parent / "problems"


@cache
def reference(name: str):
    """The design of a reference problem file."""
    return design(PROBLEMS / f"{name}.yaml")


def problem(text: str):
    """A problem from the lines that matter to a test; limits and route have defaults."""
    defaults = {
        "timelaw:": "timelaw: 1",
        "name:": "name: test",
        "route:": "route: {orientations: {lattice: 24-cell}, tour: paper}",
        "limits:": "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}",
    }
    missing = [
        line for key, line in defaults.items() if not any(part.startswith(key) for part in text.splitlines())
    ]
    return parse_problem("\n".join([*missing, text]), "test.yaml")


def random_limits(rng: np.random.Generator) -> dict[str, float]:
    """Velocity, acceleration and jerk limits over six decades."""
    return {name: float(10 ** rng.uniform(-3, 3)) for name in ("velocity", "acceleration", "jerk")}


AXIS = np.array([2.0, 3.0, 6.0]) / 7


def demand(angle, limits, axis=AXIS, inertia=None, duration=None):
    """What must hold on a leg about `axis` under limits given by name."""
    axis = np.asarray(axis, dtype=float)
    body = None if inertia is None else RigidBody(inertia)
    rows = drop_implied(list_rows(make_limits(limits, body), axis))
    return Demand(float(angle), rows, duration, make_torque_row(body, axis) if body is not None else None)


def demands(angles, limits, **others):
    return tuple(demand(angle, limits, **others) for angle in angles)


def unit_quaternions(rng: np.random.Generator, count: int) -> np.ndarray:
    q = rng.normal(size=(count, 4))
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def control_points(basis, left, free, right):
    """L g(0) + M x + R g(1): control points from the derivatives at both ends and the free coefficients."""
    parts = ((basis.from_left, left), (basis.from_free, free), (basis.from_right, right))
    return sum(matrix @ np.asarray(part, dtype=float) for matrix, part in parts)
