"""Joints of curves: continuity of the given parameter (C^k) and of the path itself (G^k), with numbers.

With X' the derivatives along u of orientation and place on both sides, the path is G¹ if X₁' = β₁ X₂' for a
β₁ > 0, G² if besides X₁'' = β₁² X₂'' + β₂ X₂', G³ if X₁''' = β₁³ X₂''' + 3 β₁ β₂ X₂'' + β₃ X₂' [HZ2019].
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from timelaw.bezier.curve import Curve
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between

SAME = 1e-10  # relative; a body passes where the certificate finds no jump at 1e-9 of its limits
ROUNDED = 1e-13  # of the origin's farthest place: a way so short is rounding
STILL = 1e-9  # of the largest rate along a curve: slower than that it has no direction
HIGHEST = 3  # order of the path's continuity that is looked for
POINTS = 101


@dataclass(frozen=True)
class Joint:
    """Where two curves meet.

    `gap` [rad] and `distance` [m] are what is left between them; `steps` the jumps along the given parameter
    of Ω, Ω' and of the place's first and second derivative; `turn` and `bend` [rad] the angles by which axis
    of rotation and way of the origin turn; `curving` and `winding` the jumps of curvature of both, per rad
    and per m; `ratios` β₁, β₂, β₃ as far as the path is smooth. `parametric` is the k of C^k.
    """

    label: str
    gap: float
    distance: float
    steps: tuple[tuple[float, float], tuple[float, float]]
    turn: float | None
    bend: float | None
    curving: float | None
    winding: float | None
    ratios: tuple[float, ...]
    parametric: int

    @property
    def geometric(self) -> int:
        """G^k of the path; C^k implies it."""
        return max(len(self.ratios), self.parametric)


@dataclass(frozen=True)
class _Side:
    """Derivatives along u (3, 3) of rotation and place, how large the first ones get, the farthest place."""

    turning: Array
    moving: Array
    fastest: tuple[float, float]
    farthest: float


def _look(curve: Curve, u: float) -> _Side:
    grid = np.linspace(0.0, 1.0, POINTS)
    at = np.array([u])
    place, way = curve.place(grid, 1)
    fastest = (
        float(np.max(np.linalg.norm(curve.turning(grid, 1)[0], axis=1))),
        float(np.max(np.linalg.norm(way, axis=1))),
    )
    turning = np.stack([value[0] for value in curve.turning(at, HIGHEST)])
    moving = np.stack([value[0] for value in curve.place(at, HIGHEST)[1:]])
    return _Side(turning, moving, fastest, float(np.max(np.linalg.norm(place, axis=1))))


def find_joints(curves: Sequence[Curve]) -> tuple[Joint, ...]:
    """The joints between curves that follow each other."""
    return tuple(_compare(before, after) for before, after in pairwise(curves))


def _compare(before: Curve, after: Curve) -> Joint:
    one, two = _look(before, 1.0), _look(after, 0.0)
    largest = [max(a, b) for a, b in zip(one.fastest, two.fastest, strict=True)]
    still = 0.0, ROUNDED * max(one.farthest, two.farthest)
    weights = [1 / size if size > least else 0.0 for size, least in zip(largest, still, strict=True)]
    x = np.hstack([one.turning * weights[0], one.moving * weights[1]])
    y = np.hstack([two.turning * weights[0], two.moving * weights[1]])
    steps = [
        np.linalg.norm(two.turning - one.turning, axis=1),
        np.linalg.norm(two.moving - one.moving, axis=1),
    ]
    ends = before.place(np.array([1.0]), 0)[0][0], after.place(np.array([0.0]), 0)[0][0]
    ratios, left = _match(x, y)
    return Joint(
        before.target,
        float(angle_between(before.control[-1], after.control[0])),
        float(np.linalg.norm(ends[1] - ends[0])),
        ((float(steps[0][0]), float(steps[0][1])), (float(steps[1][0]), float(steps[1][1]))),
        _angle(one.turning[0], two.turning[0], largest[0]),
        _angle(one.moving[0], two.moving[0], largest[1]) if weights[1] else None,
        _curvature(left, slice(0, 3), weights[0], one.turning[0], largest[0]),
        _curvature(left, slice(3, 6), weights[1], one.moving[0], largest[1]),
        ratios,
        _count_alike(x, y),
    )


def _count_alike(x: Array, y: Array) -> int:
    """Number of leading derivatives that agree."""
    for k, (a, b) in enumerate(zip(x, y, strict=True)):
        if np.linalg.norm(a - b) > SAME * max(1.0, float(np.linalg.norm(a))):
            return k
    return len(x)


def _match(x: Array, y: Array) -> tuple[tuple[float, ...], Array | None]:
    """The ratios β as far as they make the sides agree, and what is left of the second derivative (6,).

    The latter is None where the first ones do not agree in direction.
    """
    size = float(np.linalg.norm(x[0]))
    if min(size, float(np.linalg.norm(y[0]))) < STILL:
        return (), None
    first = float(x[0] @ y[0] / (y[0] @ y[0]))
    if first <= 0 or np.linalg.norm(x[0] - first * y[0]) > SAME * size:
        return (), None
    targets = x[1] - first**2 * y[1]
    second = float(targets @ y[0] / (y[0] @ y[0]))
    left = targets - second * y[0]
    if np.linalg.norm(left) > SAME * max(float(np.linalg.norm(x[1])), size**2):
        return (first,), left
    targets = x[2] - first**3 * y[2] - 3 * first * second * y[1]
    third = float(targets @ y[0] / (y[0] @ y[0]))
    smooth = np.linalg.norm(targets - third * y[0]) <= SAME * max(float(np.linalg.norm(x[2])), size**3)
    return ((first, second, third) if smooth else (first, second)), left


def _angle(a: Array, b: Array, largest: float) -> float | None:
    """Between directions; None where one side has none."""
    if min(float(np.linalg.norm(a)), float(np.linalg.norm(b))) <= STILL * largest:
        return None
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))


def _curvature(left: Array | None, part: slice, weight: float, speed: Array, largest: float) -> float | None:
    """What is left of the second derivative at the speed one; None where there is no speed or direction."""
    size = float(np.linalg.norm(speed))
    if left is None or not weight or size <= STILL * largest:
        return None
    return float(np.linalg.norm(left[part])) / weight / size**2
