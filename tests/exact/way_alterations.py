"""Alterations of the way of the body's origin: points, pieces, places of rest."""

from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import pairwise
from math import comb, inf, nextafter
from random import Random
from typing import Any

from tests.exact.alterations import STEPS
from tests.exact.curve_alterations import choose_curve

Document = dict[str, Any]
Points = list[list[float]]
FAR = (1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6)  # m


def travels(document: Document) -> bool:
    """Whether the origin moves."""
    pieces = list(_list_pieces(document))
    return bool(pieces) and all("points" in piece for piece in pieces)


def _list_pieces(document: Document) -> Iterator[dict[str, Any]]:
    for segment in document["segments"]:
        yield from segment.get("pieces", [])


def _choose_piece(rng: Random, document: Document) -> dict[str, Any]:
    """A piece in which the origin moves; one is made to move where none does."""
    piece = rng.choice(choose_curve(rng, document)["pieces"])
    piece.setdefault("points", [[1.0, 0.0, 0.0]] * 2)
    return piece


def move_place(rng: Random, document: Document) -> str:
    """A point of a way aside."""
    points, step = _choose_piece(rng, document)["points"], rng.choice((*STEPS, 1e-2, 0.1))
    index = rng.randrange(len(points))
    points[index] = [x + rng.uniform(-step, step) for x in points[index]]
    return f"a point of the way moved by {step:g}"


def nudge_places(rng: Random, document: Document) -> str:
    """Coordinates of a piece a few ulp off."""
    points, sense, steps = (
        _choose_piece(rng, document)["points"],
        rng.choice((-inf, inf)),
        rng.randint(1, 9),
    )
    axis = rng.randrange(3)
    for point in points:
        for _ in range(steps):
            point[axis] = nextafter(point[axis], sense)
    return "a way off by ulps"


def drift_places(rng: Random, document: Document) -> str:
    """Every point off by a little."""
    size = 10 ** rng.uniform(-17, -5)
    for piece in _list_pieces(document):
        if "points" in piece:
            piece["points"] = [[x + rng.uniform(-size, size) for x in p] for p in piece["points"]]
    return "all points of the way drift"


def scale_both(rng: Random, document: Document) -> str:
    """Q longer, and P by the square of that: the same motion, but for rounding; or P alone."""
    piece, factor = _choose_piece(rng, document), rng.choice((2.0, 0.25, 3.0, 1e-4))
    alone = rng.random() < 0.2
    if not alone:
        piece["control"] = [[x * factor for x in point] for point in piece["control"]]
    piece["points"] = [[x * factor**2 for x in point] for point in piece["points"]]
    return "a way scaled alone" if alone else f"a piece and its way scaled by {factor:g}"


def raise_way(rng: Random, document: Document) -> str:
    """The same way of a degree more: nothing changes but for rounding."""
    piece = _choose_piece(rng, document)
    piece["points"] = [[float(x) for x in p] for p in _raise(piece["points"], 1)]
    return "degree of a way raised"


def _raise(points: Any, by: int) -> list[list[Fraction]]:
    """Points of the same polynomial of a higher degree, exact."""
    made = [[Fraction(x) for x in p] for p in points]
    for _ in range(by):
        n = len(made)
        inner = [
            [(i * a + (n - i) * b) / n for a, b in zip(made[i - 1], made[i], strict=True)]
            for i in range(1, n)
        ]
        made = [made[0], *inner, made[-1]]
    return made


def _square(control: Points) -> list[Fraction]:
    """Control points of Q·Q, exact."""
    n = len(control) - 1
    exact = [[Fraction(x) for x in p] for p in control]
    found = [Fraction(0)] * (2 * n + 1)
    for i, p in enumerate(exact):
        for j, q in enumerate(exact):
            found[i + j] += (
                sum(a * b for a, b in zip(p, q, strict=True))
                * comb(n, i)
                * comb(n, j)
                / Fraction(comb(2 * n, i + j))
            )
    return found


def carry(piece: dict[str, Any], by: list[float]) -> None:
    """Moves a whole piece of the way: P + v D."""
    square = [[x] for x in _square(piece["control"])]
    degree = max(len(square), len(piece["points"])) - 1
    square, points = (_raise(given, degree - len(given) + 1) for given in (square, piece["points"]))
    piece["points"] = [
        [float(x + Fraction(v) * d[0]) for x, v in zip(p, by, strict=True)]
        for p, d in zip(points, square, strict=True)
    ]


def carry_away(rng: Random, document: Document) -> str:
    """The whole way elsewhere: the same rates, but for what places so far away are rounded to."""
    by = [rng.choice(FAR) * rng.choice((-1.0, 1.0)) for _ in range(3)]
    for segment in document["segments"]:
        for piece in segment.get("pieces", []):
            if "points" in piece:
                carry(piece, by)
        if "point" in segment:
            segment["point"] = [x + v for x, v in zip(segment["point"], by, strict=True)]
    return "the way carried away"


def tear_way(rng: Random, document: Document) -> str:
    """One piece of the way, or one segment, elsewhere: gaps on both its sides."""
    size = rng.choice(FAR[:4])
    by = [rng.uniform(-size, size) for _ in range(3)]
    segment = choose_curve(rng, document)
    whole = rng.random() < 0.5
    for piece in segment["pieces"] if whole else [rng.choice(segment["pieces"])]:
        piece.setdefault("points", [[1.0, 0.0, 0.0]])
        carry(piece, by)
    return f"a part of the way torn off by {size:g}"


def swap_places(rng: Random, document: Document) -> str:
    """Two neighbours in the other order, one point less, or one twice."""
    points = _choose_piece(rng, document)["points"]
    i = rng.randrange(len(points))
    how = rng.randrange(3)
    if how == 0 and len(points) > 1:
        i = max(i, 1)
        points[i - 1], points[i] = points[i], points[i - 1]
        return "points of a way swapped"
    if how == 1:
        del points[i]
        return "a point of a way deleted"
    points.insert(i, list(points[i]))
    return "a point of a way repeated"


def cut_both(rng: Random, document: Document) -> str:
    """A piece and its way in two: nothing changes but for rounding."""
    pieces = choose_curve(rng, document)["pieces"]
    index, u = rng.randrange(len(pieces)), rng.choice((0.5, rng.random()))
    whole = pieces[index]
    first, last = {"duration": whole["duration"] * u}, {"duration": whole["duration"] * (1 - u)}
    for key in ("control", "points"):
        c = whole.get(key)
        if c is None:
            continue
        left, right = [c[0]], [c[-1]]
        while len(c) > 1:
            c = [[(1 - u) * x + u * y for x, y in zip(a, b, strict=True)] for a, b in pairwise(c)]
            left.append(c[0])
            right.append(c[-1])
        first[key], last[key] = left, right[::-1]
    pieces[index : index + 1] = [first, last]
    return "a piece and its way cut in two"


def forget_way(rng: Random, document: Document) -> str:
    """No way in a segment, or in one piece, or at a dwell."""
    segment = rng.choice(document["segments"])
    segment.pop("point", None)
    pieces = segment.get("pieces", [])
    for piece in pieces if rng.random() < 0.5 else pieces[:1]:
        piece.pop("points", None)
    return "a way forgotten"


def move_rest(rng: Random, document: Document) -> str:
    """The place of a dwell, or else the first point."""
    rests = [segment["point"] for segment in document["segments"] if "point" in segment]
    point = rng.choice(rests) if rests else _choose_piece(rng, document)["points"][0]
    step = rng.choice(STEPS)
    point[rng.randrange(3)] += rng.choice((-1, 1)) * step
    return f"a place of rest moved by {step:g}"


def spike_way(rng: Random, document: Document) -> str:
    """A short piece in which the origin goes off and comes back."""
    pieces = choose_curve(rng, document)["pieces"]
    index = rng.randrange(len(pieces))
    here, size = pieces[index]["control"][0], 10 ** rng.uniform(-12, 0)
    place = pieces[index].get("points", [[1.0, 0.0, 0.0]])[0]
    points = [list(place), *([x + rng.uniform(-size, size) for x in place] for _ in range(3)), list(place)]
    duration = 10 ** rng.uniform(-30, -10)
    pieces.insert(index, {"duration": duration, "control": [list(here)] * 2, "points": points})
    return "a spike of the way inserted"


def add_linear_limit(rng: Random, document: Document) -> str:
    """A limit on the origin's rates, of all or of a segment."""
    name = rng.choice(("linear_velocity", "linear_acceleration"))
    place = document if rng.random() < 0.5 else choose_curve(rng, document)
    value = 10 ** rng.uniform(-3, 3)
    place.setdefault("limits", {})[name] = value if rng.random() < 0.5 else [value, 2 * value, value]
    return f"a limit on the {name} added"


WAY_ALTERATIONS: tuple[Callable[[Random, Document], str], ...] = (
    *[move_place] * 3,
    nudge_places,
    drift_places,
    scale_both,
    raise_way,
    carry_away,
    tear_way,
    swap_places,
    cut_both,
    forget_way,
    move_rest,
    spike_way,
    add_linear_limit,
)
