"""Random and adversarial arcs, for bounds: laws of one arc that carry every limit, whether they hold or not."""

from math import sqrt
from random import Random
from typing import Any

from tests.exact.documents import arc, document, piece

LIMITS = ("velocity", "acceleration", "jerk", "snap", "torque", "momentum")
MOST = 1e18  # the largest bound that a law file may have
WIDEST = 1e30  # the largest rate that it may have
HIGHEST = 64  # control points

Matrix = list[list[float]]


def make_case(seed: int, number: int) -> dict[str, Any]:
    """The case of that number: a document of one arc."""
    rng = Random(f"{seed}/{number}")
    axis = choose_axis(rng)
    time, rate = 10 ** rng.uniform(-6, 6), 10 ** rng.uniform(-12, 12)
    if rng.random() < 0.5:
        time, rate = 10 ** rng.uniform(-1, 1), 10 ** rng.uniform(-1, 1)
    order = rng.choice((0, 1, 2, 2, 2, 3, 3, 4))
    pieces = [make_piece(rng, order, time, rate) for _ in range(rng.choice((1, 1, 2, 3)))]
    body = make_body(rng, axis)
    limits = {name: choose_bound(rng, body, name) for name in LIMITS}
    segment = arc("1", "2", pieces, axis=axis, limits={"jerk": 1.0} if rng.random() < 0.1 else None)
    return document([segment], limits, body=body)


def choose_bound(rng: Random, body: dict[str, Any], name: str) -> float | list[float]:
    """By norm or by axis; the size matters little, only the maximum is asked for."""
    least = 2 * sum(abs(x) for x in body.get("momentum", [0])) if name == "momentum" else 0.0
    bounds = [max(10 ** rng.uniform(-6, 6), least) if rng.random() < 0.5 else MOST for _ in range(3)]
    return bounds if rng.random() < 0.5 else bounds[0]


def choose_axis(rng: Random) -> list[float]:
    """A unit vector but for rounding, or one that is too short or too long, or has a tiny component."""
    axis = [rng.gauss(0, 1) for _ in range(3)]
    way = rng.randrange(6)
    if way == 0:
        axis = [0.0, 0.0, 0.0]
        axis[rng.randrange(3)] = rng.choice((-1.0, 1.0))
    elif way == 1:
        axis[rng.randrange(3)] *= 10 ** rng.uniform(-18, -6)
    elif way == 2:
        axis = [float(rng.randint(-6, 6)) for _ in range(2)] + [rng.choice((1.0, 2.0, 3.0, 6.0))]
    length = sqrt(sum(x * x for x in axis))
    stretch = 1 + rng.uniform(-1e-9, 1e-9) if rng.random() < 0.3 else 1.0
    return [x / length * stretch for x in axis]


def make_piece(rng: Random, order: int, time: float, rate: float) -> dict[str, Any]:
    """A piece with states that go with its highest rate, or nearly cancel what that adds, or do neither."""
    h = time * rng.uniform(0.1, 1) if rng.random() < 0.8 else 10 ** rng.uniform(-30, 0)
    count = rng.choice((1, 1, 2, 2, 3, 4, 5, 6, 7)) if rng.random() < 0.98 else rng.randint(8, HIGHEST)
    control = choose_control(rng, count, rate)
    mean = sum(control) / count
    way = rng.randrange(4)
    state = []
    for level in range(order + 1):
        size = mean if way < 2 else rate
        for step in range(1, order + 2 - level):
            size *= h / step
        # way 0: what is integrated is nearly taken away again
        value = (-size, size * rng.uniform(-1, 1), size * rng.gauss(0, 1), 0.0)[way]
        state.append(min(max(value, -WIDEST), WIDEST))
    return piece(h, state, control)


def choose_control(rng: Random, count: int, rate: float) -> list[float]:
    """Control points of every kind of smoothness."""
    way = rng.randrange(6)
    if way == 0:
        return [rate] * count
    if way == 1:
        return [rate * (1 + rng.uniform(-1, 1) * 1e-15) for _ in range(count)]
    if way == 2:
        return [rate * (-1) ** i for i in range(count)]
    if way == 3:
        half = [rng.gauss(0, rate) for _ in range((count + 1) // 2)]
        return (half + [-x for x in reversed(half)])[:count]
    if way == 4:
        return [rate * 10 ** rng.uniform(-20, 0) * rng.choice((-1, 1)) for _ in range(count)]
    return [rng.gauss(0, rate) for _ in range(count)]


def make_body(rng: Random, axis: list[float]) -> dict[str, Any]:
    """A possible body whose J n or n × J n nearly cancels, or which is any body."""
    size = 10 ** rng.uniform(-12, 12) if rng.random() < 0.3 else 10 ** rng.uniform(-1, 1)
    moments = [size * rng.uniform(0.7, 1.3) for _ in range(3)]
    inertia = [[moments[i] if i == j else 0.0 for j in range(3)] for i in range(3)]
    way = rng.randrange(5)
    if way == 1:
        inertia = _turn_about(axis, moments)
    elif way in (2, 3):
        inertia = _cancel_component(rng, axis, inertia)
    elif way == 4:
        _add_products(rng, inertia, size)
    body: dict[str, Any] = {"inertia": inertia}
    if rng.random() < 0.5:
        turning = rng.random() < 0.6
        momentum = [rng.gauss(0, size) if turning and rng.random() < 0.7 else 0.0 for _ in range(3)]
        body |= {"actuator": "wheels", "momentum": momentum}
    return body


def _turn_about(axis: list[float], moments: list[float]) -> Matrix:
    """J = a 1 + b n nᵀ: n is a principal axis but for rounding, so n × J n is rounding."""
    return [
        [moments[0] * (i == j) + (moments[1] - moments[0]) * axis[i] * axis[j] for j in range(3)]
        for i in range(3)
    ]


def _add_products(rng: Random, inertia: Matrix, size: float) -> None:
    """Products of inertia of either sign, small enough for a possible body."""
    for i, j in ((0, 1), (0, 2), (1, 2)):
        inertia[i][j] = inertia[j][i] = size * rng.uniform(-0.1, 0.1)


def _cancel_component(rng: Random, axis: list[float], inertia: Matrix) -> Matrix:
    """(J n)_i of 1e-17 of its terms, where a product of inertia can be chosen so; else as it was."""
    i, j, k = rng.sample(range(3), 3)
    if not axis[j]:
        return inertia
    other = rng.uniform(-0.1, 0.1) * inertia[i][i]
    product = -(inertia[i][i] * axis[i] + other * axis[k]) / axis[j]
    if abs(product) > 0.15 * inertia[i][i]:
        return inertia
    inertia[i][j] = inertia[j][i] = product
    inertia[i][k] = inertia[k][i] = other
    return inertia
