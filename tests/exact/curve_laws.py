"""Laws with rational segments that keep every promise, their limits hardly above what is reached; to be altered."""

import copy
import json
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from tests.exact.documents import ONE, X, arc, document, dwell, quintic, rational, unit
from tests.exact.handmade import ASLANT, follow
from timelaw.certificate import certify
from timelaw.export import format_law
from timelaw.law_file import from_document
from timelaw.through.columns import number_columns
from timelaw.through.least_time import LeastTime
from timelaw.through.measures import list_limit_measures
from timelaw.through.search import improve
from timelaw.through.start import begin

Document = dict[str, Any]

LIMITS = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}
NODES = [ONE, [0.8, 0.36, 0.48, 0.0], [0.48, 0.64, 0.0, 0.6], [0.1, 0.7, -0.5, 0.5]]
INERTIA = [[12.0, 1.0, -0.5], [1.0, 10.0, 0.7], [-0.5, 0.7, 8.0]]
WHEELS = {"inertia": INERTIA, "actuator": "wheels", "momentum": [0.2, -0.3, 0.6]}
ABOVE = 1 + 1e-12  # of what is reached


def make_chain(
    nodes: Sequence[list[float]], degree: int, count: int, *, searched: bool = True
) -> list[dict[str, Any]]:
    """Rational segments through nodes, of class C², from rest to rest, `count` pieces each."""
    turns = np.array([unit(node) for node in nodes])
    turns[1:] *= np.cumprod(np.sign(np.sum(turns[1:] * turns[:-1], axis=1)))[:, None]
    angles = np.array([2 * np.arccos(min(a @ b, 1.0)) for a, b in pairwise(turns)])
    limits = list_limit_measures(LIMITS, [{}] * len(angles))
    curve = begin(turns, [], 2 * angles, degree, limits)
    if searched:
        held = np.array([True, *[False] * (len(nodes) - 2), True])
        curve = improve(curve, number_columns(curve, held), angles, LeastTime(limits)).curve
    legs = [
        rational(str(k + 1), str(k + 2), halve([piece(h, points)], count))
        for k, (h, points) in enumerate(zip(curve.steps, curve.control(), strict=True))
    ]
    return follow(*legs)


def piece(duration: float, control: Any) -> dict[str, Any]:
    """A piece of a rational segment."""
    return {"duration": float(duration), "control": np.asarray(control).tolist()}


def halve(pieces: list[dict[str, Any]], count: int) -> list[dict[str, Any]]:
    """The same curve in so many pieces, each time the last one halved by de Casteljau."""
    while len(pieces) < count:
        last = pieces[-1]
        c = np.array(last["control"])
        left, right = [c[0]], [c[-1]]
        while len(c) > 1:
            c = (c[:-1] + c[1:]) / 2
            left.append(c[0])
            right.append(c[-1])
        h = last["duration"] / 2
        pieces = [*pieces[:-1], piece(h, left), piece(h, right[::-1])]
    return pieces


def make_rest(first: list[float], last: list[float], together: int, time: float) -> dict[str, Any]:
    """One piece from rest to rest, the first `together` points and the last ones the same."""
    middle = unit([a + b for a, b in zip(first, last, strict=True)])
    return piece(time, [first] * together + [[1.5 * x for x in middle]] + [last] * together)


def touch(law: Document) -> Document:
    """The same law with limits as low as can be, and with its record."""
    law = copy.deepcopy(law)
    reached = {c.limit: c.upper * ABOVE for c in certify(from_document(law)).limits}
    for name, bounds in law["limits"].items():
        by_axis = isinstance(bounds, list)
        law["limits"][name] = [reached[f"{name} {axis}"] for axis in "xyz"] if by_axis else reached[name]
    read = from_document(law)
    return json.loads(format_law(read, certify(read), {}))


def make_mixed() -> Document:
    """An arc, a dwell, two rational segments, a dwell, and an arc."""
    first = arc("0", "1", [quintic(1.0, 3.0)], axis=ASLANT)
    chain = make_chain([first["end"], *NODES[1:3]], 6, 1)
    last = arc("3", "4", [quintic(0.7, 2.0)], axis=X, angle=0.7, start=chain[-1]["end"])
    here, there = ([*s["pieces"][k]["control"][k]] for s, k in ((chain[0], 0), (chain[-1], -1)))
    dwells = [dwell("1", 0.5, start_time=0.0, orientation=unit(here))]
    dwells += [dwell("3", 1.0, start_time=0.0, orientation=unit(there))]
    return document(follow(first, dwells[0], *chain, dwells[1], last), dict(LIMITS), continuity=2)


def _list_laws() -> Iterator[tuple[str, Document]]:
    free = [1e3] * 3
    chain = make_chain(NODES[:3], 6, 1)
    yield "curves", document(chain, dict(LIMITS), continuity=2)
    yield "curves in pieces", document(make_chain(NODES, 7, 3), dict.fromkeys(LIMITS, free), continuity=2)
    plain = make_chain(NODES[:3], 5, 2, searched=False)
    plain[1]["limits"] = {"velocity": 2.0}
    yield "quintic curves", document(plain, dict(LIMITS), continuity=2)
    body = {"inertia": INERTIA}
    yield "torque of curves", document(chain, {"torque": 1e3, "momentum": 1e3}, continuity=2, body=body)
    limits = {"torque": free, "momentum": free, "jerk": 10.0}
    yield "wheels on curves", document(chain, limits, continuity=2, body=WHEELS)
    rest = rational("1", "2", [make_rest(ONE, NODES[1], 4, 3.0)])
    limits = {**LIMITS, "snap": 1e3, "torque": 1e3}
    yield "a smooth curve", document([rest], limits, continuity=3, body={**WHEELS, "momentum": [0.0] * 3})
    yield "arcs and curves", make_mixed()


@cache
def list_curve_laws() -> dict[str, Document]:
    """All of them, by name."""
    return {name: touch(law) for name, law in _list_laws()}
