"""Random and adversarial ways of the body's origin, and deviations from arcs, for bounds."""

from fractions import Fraction
from math import cos, pi, sin
from random import Random
from typing import Any

from tests.exact.arcs import choose_axis, choose_bound
from tests.exact.curve_cases import (
    LONGEST,
    WAYS,
    WEIGHT,
    choose_degree,
    draw_unit,
    rescale,
)
from tests.exact.documents import document, rational, unit
from tests.exact.motion import Motion
from tests.exact.quaternions import multiply
from tests.exact.way_alterations import carry

LIMITS = ("linear_velocity", "linear_acceleration")
FARTHEST = 1e12  # m
Point = list[float]


def make_case(seed: int, number: int) -> dict[str, Any]:
    """The case of that number: a document of one rational segment on which Q is nowhere zero."""
    rng = Random(f"{seed}/{number}")
    while True:
        document = draw_document(rng)
        if not any(segment.find_undefined() for segment in Motion(document).segments):
            return document


def draw_document(rng: Random) -> dict[str, Any]:
    """A document whose origin moves, in which everything about the path is limited."""
    axis = choose_axis(rng)
    time = 10 ** rng.uniform(-1, 1) if rng.random() < 0.5 else 10 ** rng.uniform(-9, 9)
    pieces = []
    for _ in range(rng.choice((1, 1, 1, 2))):
        duration = time * rng.uniform(0.1, 1) if rng.random() < 0.85 else 10 ** rng.uniform(-30, 0)
        control = rng.choice((*WAYS, stay_near, stay_near, go_half_round))(rng, axis, choose_degree(rng))
        piece = {"duration": min(duration, LONGEST), "control": rescale(rng, control)}
        pieces.append(piece | {"points": draw_points(rng)})
        move_away(rng, pieces[-1])
    limits = {name: choose_bound(rng, {}, name) for name in LIMITS}
    leg = rational("1", "2", pieces, limits={"deviation": 1.0})
    if rng.random() < 0.3:  # ends that the motion does not keep to: only the arc counts
        leg |= {"start": draw_unit(rng), "end": draw_unit(rng)}
    elif rng.random() < 0.3:
        leg["end"] = turn_little(rng, leg["start"], axis)
    return document([leg], limits)


def turn_little(rng: Random, start: Point, axis: Point) -> Point:
    """An arc that is nearly a point, or nearly half a great circle."""
    angle = 10 ** rng.uniform(-9, -1)
    half = angle / 2 if rng.random() < 0.5 else pi - angle / 2
    return unit(multiply(start, [cos(half), *(sin(half) * x for x in axis)]))


def stay_near(rng: Random, axis: Point, degree: int) -> list[Point]:
    """Along an arc, and beside it by little, beyond its ends or not."""
    angle, aside = rng.uniform(0.1, 3.0), 10 ** rng.uniform(-12, -1)
    points = []
    for i in range(degree + 1):
        half = angle * (i / degree + rng.uniform(-0.3, 0.3) * (rng.random() < 0.5)) / 2
        points.append([x + rng.gauss(0, aside) for x in (cos(half), *(sin(half) * v for v in axis))])
    return points


def go_half_round(rng: Random, axis: Point, degree: int) -> list[Point]:
    """As far from an arc as can be, or nearly."""
    angle, near = rng.uniform(0.1, 3.0), 10 ** rng.uniform(-9, -1)
    start = [1.0, 0.0, 0.0, 0.0]
    end = [cos(angle / 2), *(sin(angle / 2) * x for x in axis)]
    other = [-axis[1], axis[0], 0.0] if abs(axis[2]) < 0.9 else [0.0, -axis[2], axis[1]]
    far = unit([near, *other])
    inner = [far] * max(degree - 1, 1)
    return [start, *([x * rng.choice((1.0, 1e3)) for x in p] for p in inner), end]


def draw_points(rng: Random) -> list[Point]:
    """A way of any degree and size, at rest at both ends or not."""
    size, count = 10 ** rng.uniform(-6, 6), rng.choice((1, 2, 2, 3, 4, 5, 6, 7, 9, 12, 20))
    way = rng.randrange(4)
    if way == 0:
        return [[rng.gauss(0, size)] * 3] * count
    points = [[rng.gauss(0, size) for _ in range(3)] for _ in range(count)]
    if way == 1:
        points = [[x * 10 ** rng.uniform(-12, 0) for x in point] for point in points]
    if way == 2:
        points = [points[0]] * 3 + points + [points[-1]] * 3
    return points


def move_away(rng: Random, piece: dict[str, Any]) -> None:
    """Now and then the whole way is far off: what is left of the rates nearly cancels; P is of degree 2d then."""
    if rng.random() >= 0.4 or len(piece["control"]) > 8:
        return
    if rng.random() < 0.5:
        piece["points"] = [[0.0] * 3]
    largest = max(abs(Fraction(x)) for point in piece["control"] for x in point)
    carry(
        piece,
        [rng.gauss(0, 1) * 10 ** rng.uniform(-3, 6) / max(float(largest) ** 2, 1 / WEIGHT) for _ in range(3)],
    )
    piece["points"] = [[max(min(x, FARTHEST), -FARTHEST) for x in point] for point in piece["points"]]
