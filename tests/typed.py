"""Orientations as people and programs write them: rounded, in single precision, by significant digits."""

import numpy as np

from timelaw.errors import InputError
from timelaw.numerics.quaternion import from_axis_angle, multiply
from timelaw.orientations import OrientationSet
from timelaw.orientations.precision import QUATERNIONS, measure_precision
from timelaw.route import Route, lay_route
from timelaw.tours import Tour

STEP = {"single": 1e-7, "shortest single": 1e-7, "nine digits of single": 1e-7, "%.4g": 1e-4, "%.6g": 1e-6}
WAYS = (3, 4, 5, 6, 7, 8, 9, *STEP)


def step(way) -> float:
    """The unit of the last digit, or thereabouts."""
    return STEP.get(way) or 10.0**-way


def write(q: np.ndarray, way) -> np.ndarray:
    """Numbers (N, width) as they read back after they were written with so many digits, or in another way."""
    if way == "single":
        return q.astype(np.float32).astype(float)
    texts = {
        "shortest single": lambda x: str(np.float32(x)),
        "nine digits of single": lambda x: f"{np.float32(x):.9g}",
        "%.4g": lambda x: f"{x:.4g}",
        "%.6g": lambda x: f"{x:.6g}",
    }
    text = texts.get(way, lambda x: f"{x:.{way}f}")
    return np.array([[float(text(x)) for x in row] for row in q])


def unit(rng: np.random.Generator, size: int = 3) -> np.ndarray:
    v = rng.normal(size=size)
    return v / np.linalg.norm(v)


def go_on(start: np.ndarray, axis: np.ndarray, angles) -> np.ndarray:
    """Orientations reached from one by turns [rad] about an axis, one after the other."""
    return multiply(start, from_axis_angle(axis, np.cumsum(angles)))


def read_rows(rows: np.ndarray, label=str) -> OrientationSet:
    """A set of quaternions with the precision that its numbers show."""
    q = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    labels = tuple(label(i + 1) for i in range(len(q)))
    return OrientationSet(q, labels, "list", precision=measure_precision(rows, QUATERNIONS))


def lay(rows: np.ndarray, *, closed: bool = False) -> tuple[OrientationSet, Route]:
    """The set, and the route through it in its order; checked for what every route has to hold."""
    points = read_rows(rows)
    way = lay_route(points, Tour(tuple(range(len(points))), closed, 0.0, 0.0, ()))
    check(points, way)
    return points, way


def lay_if_apart(rows: np.ndarray, *, closed: bool = False) -> Route | None:
    """None where two in a row are one within the precision."""
    try:
        return lay(rows, closed=closed)[1]
    except InputError as error:
        assert "are the same orientation" in str(error)  # noqa: PT017
        return None


def corners(way: Route) -> list[int]:
    return [k for k, node in enumerate(way.nodes) if node.kind == "corner"]


def check(points: OrientationSet, way: Route) -> None:
    """No node moves farther than the precision; axes of a run are one; legs lead where they say and join."""
    assert max(node.moved for node in way.nodes) <= points.precision.angle * (1 + 1e-9)
    for leg in way.legs:
        reached = multiply(leg.start, from_axis_angle(leg.axis, np.array(leg.angle)))
        assert np.max(np.abs(reached - leg.end)) < 2e-14
        assert abs(np.linalg.norm(leg.axis) - 1) < 1e-15
    for k, (before, after) in enumerate(zip(way.legs, way.legs[1:], strict=False), 1):
        np.testing.assert_array_equal(before.end, after.start)
        if way.nodes[k].kind == "straight":
            assert np.max(np.abs(before.axis - after.axis)) <= 1e-15
