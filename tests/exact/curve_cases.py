"""Random and adversarial rational segments, for bounds: laws of one that carry every limit, held or not."""

from collections.abc import Callable
from math import cos, sin
from random import Random
from typing import Any

from tests.exact.arcs import LIMITS, choose_axis, choose_bound, make_body
from tests.exact.documents import document, rational
from tests.exact.motion import Motion
from tests.exact.quaternions import multiply

HIGHEST = 15  # degree
WEIGHT = 1e6  # the largest component that a control point may have
SHORTEST, LONGEST = 1e-9, 1e12  # s, of a segment

Point = list[float]


def make_case(seed: int, number: int) -> dict[str, Any]:
    """The case of that number: a document of one rational segment on which Q is nowhere zero."""
    rng = Random(f"{seed}/{number}")
    while True:
        document = draw_document(rng)
        if not any(segment.find_undefined() for segment in Motion(document).segments):
            return document


def draw_document(rng: Random) -> dict[str, Any]:
    """A document of one rational segment."""
    axis = choose_axis(rng)
    time = 10 ** rng.uniform(-1, 1) if rng.random() < 0.5 else 10 ** rng.uniform(-12, 12)
    pieces = []
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        duration = time * rng.uniform(0.1, 1) if rng.random() < 0.85 else 10 ** rng.uniform(-30, 0)
        control = rescale(rng, rng.choice(WAYS)(rng, axis, choose_degree(rng)))
        pieces.append({"duration": min(duration, LONGEST), "control": control})
    body = make_body(rng, axis)
    limits = {name: choose_bound(rng, body, name) for name in LIMITS}
    own = {"jerk": 1.0} if rng.random() < 0.1 else None
    return document([rational("1", "2", pieces, limits=own)], limits, body=body)


def choose_degree(rng: Random) -> int:
    """Mostly what searches make, now and then the least and the largest."""
    return rng.choice((1, 2, 3, 4, 5, 5, 6, 6, 6, 7, 7, 8, 9, 11, 13, HIGHEST))


def draw_unit(rng: Random) -> Point:
    """A random orientation."""
    return divide([rng.gauss(0, 1) for _ in range(4)])


def divide(point: Point) -> Point:
    """Of norm one."""
    size = sum(x * x for x in point) ** 0.5
    return [x / size for x in point]


def rescale(rng: Random, control: list[Point]) -> list[Point]:
    """All points together made longer or shorter, or each one."""
    way = rng.randrange(5)
    most = max(abs(x) for point in control for x in point)
    if way == 0:
        factors = [10 ** rng.uniform(-20, 6)] * len(control)
    elif way == 1:
        factors = [10 ** rng.uniform(-0.5, 0.5) for _ in control]
    elif way == 2 or most > WEIGHT:
        factors = [WEIGHT] * len(control)
    else:
        return control
    return [
        [max(min(x / most * f, WEIGHT), -WEIGHT) for x in p] for p, f in zip(control, factors, strict=True)
    ]


def wander(rng: Random, _: Point, degree: int) -> list[Point]:
    """A random walk, of steps that are tiny, or such that Q may come near zero."""
    step = 10 ** rng.uniform(-2, 0) if rng.random() < 0.7 else 10 ** rng.uniform(-14, -2)
    points = [draw_unit(rng)]
    for _ in range(degree):
        points.append([x + rng.gauss(0, step) for x in points[-1]])
    return points


def rest(rng: Random, axis: Point, degree: int) -> list[Point]:
    """From rest to rest: points that stand together at the ends."""
    together = min(rng.choice((2, 3, 4)), (degree + 1) // 2)
    inner = wander(rng, axis, degree)[together : degree + 1 - together]
    first, last = draw_unit(rng), draw_unit(rng)
    if sum(a * b for a, b in zip(first, last, strict=True)) < 0:
        last = [-x for x in last]
    return [first] * together + inner + [last] * (degree + 1 - together - len(inner))


def turn_steadily(rng: Random, axis: Point, degree: int) -> list[Point]:
    """About one axis, at a nearly constant rate: what is above the first order nearly cancels."""
    angle, start = rng.uniform(0, 1) * 10 ** rng.uniform(-6, 0), draw_unit(rng)
    points = []
    for i in range(degree + 1):
        half = angle * i / degree
        turned = [cos(half), *(sin(half) * x for x in axis)]
        points.append(multiply(start if rng.random() < 0.5 else [1.0, 0.0, 0.0, 0.0], turned))
        start = start if rng.random() < 0.95 else draw_unit(rng)
    return points


def turn_in_plane(rng: Random, axis: Point, degree: int) -> list[Point]:
    """Points in one plane of quaternions: all rates are along one axis, the rest is zero or rounding."""
    start = [1.0, 0.0, 0.0, 0.0] if rng.random() < 0.5 else draw_unit(rng)
    points = []
    for _ in range(degree + 1):
        a, b = 1 + rng.gauss(0, 0.2), rng.gauss(0, 0.4)
        points.append(multiply(start, [a, *(b * x for x in axis)]))
    return points


def graze_zero(rng: Random, axis: Point, degree: int) -> list[Point]:
    """Q comes near zero between control points that do not."""
    points = wander(rng, axis, max(degree, 2))
    near = 10 ** (rng.uniform(-3, -0.5) if rng.random() < 0.9 else rng.uniform(-9, -3))
    aim = [x * near for x in draw_unit(rng)]
    n = len(points) - 1
    u, k = rng.uniform(0.2, 0.8), rng.randrange(1, n) if n > 1 else 1
    weights = _weigh(n, u)
    for c in range(4):
        others = sum(w * p[c] for i, (w, p) in enumerate(zip(weights, points, strict=True)) if i != k)
        points[k][c] = (aim[c] - others) / weights[k]
    return points


def _weigh(n: int, u: float) -> list[float]:
    """Bernstein's polynomials at u."""
    weights = [1.0]
    for k in range(1, n + 1):
        weights = [
            (weights[i] * (1 - u) if i < k else 0.0) + (weights[i - 1] * u if i else 0.0)
            for i in range(k + 1)
        ]
    return weights


def stand_still(rng: Random, _: Point, degree: int) -> list[Point]:
    """Nearly constant: the motion is in the last digits; or only the length changes."""
    start, step = draw_unit(rng), 10 ** rng.uniform(-16, -9)
    if rng.random() < 0.3:
        return [[x * (1 + rng.uniform(-0.5, 0.5)) for x in start[:1]] + [0.0] * 3 for _ in range(degree + 1)]
    return [[x + rng.uniform(-step, step) for x in start] for _ in range(degree + 1)]


WAYS: tuple[Callable[[Random, Point, int], list[Point]], ...] = (
    *[wander] * 3,
    *[rest] * 3,
    turn_steadily,
    turn_in_plane,
    graze_zero,
    stand_still,
)
