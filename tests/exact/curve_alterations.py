"""Alterations of rational segments: control points, their weights, pieces, and what leaves the motion as it is."""

import copy
from collections.abc import Callable
from itertools import pairwise
from math import inf, nextafter
from random import Random
from typing import Any

from tests.exact.alterations import STEPS

Document = dict[str, Any]
Segment = dict[str, Any]
NUDGES = (1e-15, 1e-13, 1e-12, 1e-10, 1e-9, 1e-7, 1e-5, 1e-2, 1.0)


def is_curved(document: Document) -> bool:
    """Whether there is a rational segment."""
    return any(segment["kind"] == "rational" for segment in document["segments"])


def choose_curve(rng: Random, document: Document) -> Segment:
    """One rational segment."""
    return rng.choice([segment for segment in document["segments"] if segment["kind"] == "rational"])


def choose_piece(rng: Random, document: Document) -> dict[str, Any]:
    """One of its pieces."""
    return rng.choice(choose_curve(rng, document)["pieces"])


def move_point(rng: Random, document: Document) -> str:
    """A control point a little aside."""
    control, step = choose_piece(rng, document)["control"], rng.choice((*STEPS, 1e-2, 0.1))
    index = rng.randrange(len(control))
    control[index] = [x + rng.uniform(-step, step) for x in control[index]]
    return f"a control point moved by {step:g}"


def weigh_point(rng: Random, document: Document) -> str:
    """A control point longer or shorter."""
    control, step = choose_piece(rng, document)["control"], rng.choice((*STEPS, 0.1))
    index = rng.randrange(len(control))
    factor = 1 + rng.choice((-1, 1)) * step
    control[index] = [x * factor for x in control[index]]
    return f"a control point weighed {factor:.15g}"


def scale_piece(rng: Random, document: Document) -> str:
    """All points of a piece longer or shorter: the motion is the same but for rounding, none by a power of two."""
    piece, factor = choose_piece(rng, document), rng.choice((2.0, 0.125, 3.0, 1e-3, 1e5, 1e-30))
    piece["control"] = [[x * factor for x in point] for point in piece["control"]]
    return f"a piece scaled by {factor:g}"


def turn_around(rng: Random, document: Document) -> str:
    """-Q instead of Q, in a piece, or in a whole segment with its ends: the same orientations, the other way."""
    segment = choose_curve(rng, document)
    whole = rng.random() < 0.5
    for piece in segment["pieces"] if whole else [rng.choice(segment["pieces"])]:
        piece["control"] = [[-x for x in point] for point in piece["control"]]
    if whole and rng.random() < 0.5:
        segment["start"], segment["end"] = ([-x for x in segment[key]] for key in ("start", "end"))
        return "a segment and its ends turned around"
    return "a segment turned around" if whole else "a piece turned around"


def reweigh(rng: Random, document: Document) -> str:
    """Weights that grow from point to point: the same path, at another speed."""
    piece, step = choose_piece(rng, document), rng.choice((*STEPS, 0.1))
    piece["control"] = [[x * (1 + step) ** i for x in point] for i, point in enumerate(piece["control"])]
    return f"weights grow by {step:g}"


def run_backwards(rng: Random, document: Document) -> str:
    """The points of a piece in the other order, the ends of its segment too."""
    segment = choose_curve(rng, document)
    for piece in segment["pieces"]:
        piece["control"].reverse()
    segment["pieces"].reverse()
    if rng.random() < 0.5:
        segment["start"], segment["end"] = segment["end"], segment["start"]
    return "a segment runs backwards"


def swap_points(rng: Random, document: Document) -> str:
    """Two neighbours in the other order."""
    control = choose_piece(rng, document)["control"]
    i = rng.randrange(len(control) - 1)
    control[i], control[i + 1] = control[i + 1], control[i]
    return "control points swapped"


def drop_point(rng: Random, document: Document) -> str:
    """One point less, or one twice."""
    control = choose_piece(rng, document)["control"]
    i = rng.randrange(len(control))
    if rng.random() < 0.5:
        del control[i]
        return "a control point deleted"
    control.insert(i, list(control[i]))
    return "a control point repeated"


def raise_degree(rng: Random, document: Document) -> str:
    """The same curve of a degree more: nothing changes but for rounding."""
    piece = choose_piece(rng, document)
    c = piece["control"]
    n = len(c)
    inner = [[(i * a + (n - i) * b) / n for a, b in zip(c[i - 1], c[i], strict=True)] for i in range(1, n)]
    piece["control"] = [c[0], *inner, c[-1]]
    return "degree raised"


def cut_piece(rng: Random, document: Document) -> str:
    """A piece in two: nothing changes but for rounding."""
    pieces = choose_curve(rng, document)["pieces"]
    index = rng.randrange(len(pieces))
    u, c = rng.choice((0.5, rng.random())), pieces[index]["control"]
    left, right = [c[0]], [c[-1]]
    while len(c) > 1:
        c = [[(1 - u) * x + u * y for x, y in zip(a, b, strict=True)] for a, b in pairwise(c)]
        left.append(c[0])
        right.append(c[-1])
    h = pieces[index]["duration"]
    parts = ((h * u, left), (h - h * u, right[::-1]))
    pieces[index : index + 1] = [{"duration": t, "control": control} for t, control in parts]
    return "a piece cut in two"


def insert_stop(rng: Random, document: Document) -> str:
    """A piece at rest, of any length."""
    segment = choose_curve(rng, document)
    pieces = segment["pieces"]
    index = rng.randrange(len(pieces) + 1)
    here = pieces[index]["control"][0] if index < len(pieces) else pieces[-1]["control"][-1]
    duration = 10 ** rng.uniform(-30, 0)
    pieces.insert(index, {"duration": duration, "control": [list(here)] * rng.choice((2, 4, 6))})
    if rng.random() < 0.5:
        segment["duration"] = sum(p["duration"] for p in pieces)
        return "a piece at rest inserted, its time counted"
    return "a piece at rest inserted"


def insert_curve_spike(rng: Random, document: Document) -> str:
    """A short piece that leaves where it is and comes back, or does not."""
    pieces = choose_curve(rng, document)["pieces"]
    index = rng.randrange(len(pieces))
    here = pieces[index]["control"][0]
    size = 10 ** rng.uniform(-16, 0)
    control = [[x + rng.uniform(-size, size) for x in here] for _ in range(rng.randint(2, 6))]
    control[0] = list(here)
    if rng.random() < 0.7:
        control[-1] = list(here)
    pieces.insert(index, {"duration": 10 ** rng.uniform(-30, -10), "control": control})
    return "a spike of Q inserted"


def empty_curve(rng: Random, document: Document) -> str:
    """Q through zero, or nearly."""
    control, size = choose_piece(rng, document)["control"], rng.choice((0.0, 1e-12, 1e-6, 1e-3))
    index = rng.randrange(len(control))
    control[index:] = [[-x + rng.uniform(-size, size) for x in point] for point in control[index:]]
    if rng.random() < 0.3:
        control[:] = [[0.0] * 4 for _ in control]
    return "Q through zero"


def drift_points(rng: Random, document: Document) -> str:
    """Every control point off by a little."""
    size = 10 ** rng.uniform(-16, -7)
    for segment in document["segments"]:
        for piece in segment["pieces"] if segment["kind"] == "rational" else ():
            piece["control"] = [[x + rng.uniform(-size, size) for x in point] for point in piece["control"]]
    return "all control points drift"


def turn_segment(rng: Random, document: Document) -> str:
    """One component of all points of a segment a few ulp off."""
    segment, sense = choose_curve(rng, document), rng.choice((-inf, inf))
    component, steps = rng.randrange(4), rng.randint(1, 5)
    for piece in segment["pieces"]:
        for point in piece["control"]:
            for _ in range(steps):
                point[component] = nextafter(point[component], sense)
    return "components of a segment off by ulps"


def share_time(rng: Random, document: Document) -> str:
    """One piece longer by what another is shorter, or one segment by what the next is."""
    by = rng.choice(NUDGES)
    pieces = choose_curve(rng, document)["pieces"]
    if len(pieces) > 1:
        i = rng.randrange(len(pieces) - 1)
        step = by * min(pieces[i]["duration"], pieces[i + 1]["duration"]) / 2
        pieces[i]["duration"] += step
        pieces[i + 1]["duration"] -= step
        return f"time shared anew by {by:g}"
    pieces[0]["duration"] *= 1 - by / 2
    return f"a piece shorter by {by / 2:g}"


def call_it_an_arc(rng: Random, document: Document) -> str:
    """Another kind, or none."""
    choose_curve(rng, document)["kind"] = rng.choice(("arc", "dwell", "Rational", "bezier"))
    return "another kind"


def copy_piece(rng: Random, document: Document) -> str:
    """A piece of one segment in the place of one of another."""
    one, other = choose_curve(rng, document), choose_curve(rng, document)
    piece = copy.deepcopy(rng.choice(one["pieces"]))
    other["pieces"][rng.randrange(len(other["pieces"]))] = piece
    return "a piece copied from another segment"


CURVE_ALTERATIONS: tuple[Callable[[Random, Document], str], ...] = (
    *[move_point] * 3,
    *[weigh_point] * 2,
    scale_piece,
    turn_around,
    reweigh,
    run_backwards,
    swap_points,
    drop_point,
    raise_degree,
    cut_piece,
    insert_stop,
    insert_curve_spike,
    empty_curve,
    drift_points,
    turn_segment,
    share_time,
    call_it_an_arc,
    copy_piece,
)
