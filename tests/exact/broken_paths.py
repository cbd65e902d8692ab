"""Laws that break one promise each, or just none, by what they say of their path."""

import json
from collections.abc import Iterator
from itertools import pairwise
from math import comb, cos, nextafter, pi, sin
from typing import Any

from numpy.polynomial.legendre import leggauss

from tests.exact.broken import Broken, _turn_aside, _with
from tests.exact.broken_curves import _lower
from tests.exact.curve_laws import make_rest, piece
from tests.exact.documents import ONE, document, rational, unit
from tests.exact.false_records import record
from tests.exact.handmade import follow
from tests.exact.path_laws import halve_travel, list_path_laws, make_travel
from tests.exact.way_alterations import carry

Document = dict[str, Any]

TURNED = [0.8, 0.36, 0.48, 0.0]
FREE = {"velocity": 1e9}
SPIKE = 1e-4  # of a piece
QUADRATURE = 16  # nodes, at one of which a spike may stand


def _shift(way: str, by: float) -> dict[str, Any]:
    """A setting that moves points along x."""
    return {way: lambda points: [[x + by, y, z] for x, y, z in points]}


def make_turn(*places: list[float], bound: float) -> Document:
    """From the first orientation to the last by the others, at rest in each; with a limited deviation."""
    pieces = [piece(1.0, [a] * 3 + [b] * 3) for a, b in pairwise(places)]
    return _separate(
        document([rational("1", "2", pieces, limits={"deviation": bound})], dict(FREE), continuity=2)
    )


def turned(angle: float, aside: float = 0.0) -> list[float]:
    """Turned about x by an angle, and out of that circle by another one."""
    c, s = cos(aside / 2), sin(aside / 2)
    return [cos(angle / 2) * c, sin(angle / 2) * c, s, 0.0]


def _separate(law: Document) -> Document:
    """A copy in which each number stands by itself, to be altered alone."""
    return json.loads(json.dumps(law))


def make_hop(jump: float, *before: dict[str, Any], **others: Any) -> Document:
    """After other legs there and back along x; where the two meet the acceleration of the origin jumps."""
    there, back = (make_rest(a, b, 3, 1.0) for a, b in ((ONE, TURNED), (TURNED, ONE)))
    there["points"] = [[0.0] * 3] * 3 + [[0.5, 0.0, 0.0]] + [[1.0, 0.0, 0.0]] * 3
    back["points"] = there["points"][::-1]
    back["points"][2] = [1.0 - jump / 30, 0.0, 0.0]
    legs = follow(*before, rational("1", "2", [there]), rational("2", "3", [back]))
    return _separate(document(legs, dict(FREE), **{"continuity": 2, **others}))


def make_brief(jump: float) -> Document:
    """The same after a leg of a nanosecond in which the origin moves by a nanometre."""
    points = [[1e-9, 0.0, 0.0]] * 3 + [[0.0] * 3] * 3
    return make_hop(jump, rational("0", "1", [piece(1e-9, [ONE] * 2) | {"points": points}]))


def make_way_spike(jump: float) -> Document:
    """The same after a leg in which Q comes near zero at a place at which quadrature looks.

    The body turns once round there, and the origin is at Q_x²/|Q|²: off by a metre and back.
    """
    u, n = float(leggauss(QUADRATURE)[0][QUADRATURE // 2] + 1) / 2, 10
    points = [[1.0, 0.0, 0.0, 0.0]] * 4 + [[0.5 - 0.5 * i, 0.0, 0.0, 0.0] for i in range(3)]
    points += [[-1.0, 0.0, 0.0, 0.0]] * 4
    weights = [comb(n, i) * u**i * (1 - u) ** (n - i) for i in range(n + 1)]
    rest = sum(w * p[0] for i, (w, p) in enumerate(zip(weights, points, strict=True)) if i != 5)
    points[5] = [-rest / weights[5], SPIKE / weights[5], 0.0, 0.0]
    # x² for x = points[5][1] B₅: one point of degree 20
    height = points[5][1] ** 2 * comb(n, 5) ** 2 / comb(2 * n, 10)
    way = [[0.0] * 3] * 10 + [[height, 0.0, 0.0]] + [[0.0] * 3] * 10
    spike = rational("0", "1", [piece(1.0, points) | {"points": way}])
    law = make_hop(jump, spike)
    for segment in law["segments"][1:]:  # on from -1
        segment["pieces"][0]["control"] = [[-x for x in q] for q in segment["pieces"][0]["control"]]
        segment["start"], segment["end"] = ([-x for x in segment[key]] for key in ("start", "end"))
    return law


def list_tolerable_paths() -> dict[str, Document]:
    """Laws that are off by what is tolerated, or not at all."""
    laws = list_path_laws()
    far = make_travel()
    for segment in far["segments"]:
        for one in segment.get("pieces", []):
            carry(one, [1e4, 0.0, -3e4])
        if "point" in segment:
            x, y, z = segment["point"]
            segment["point"] = [x + 1e4, y, z - 3e4]
    apart = _with(make_travel(), **_shift("segments__2__pieces__0__points", 0.5e-9))
    limits = {"velocity": 2.0, "linear_velocity": [5.0, 5.0, 5.0]}
    return {
        "a way": make_travel(),
        "a way in two pieces": halve_travel(make_travel()),
        "a way far away": far,
        "a small gap of the way": apart,
        "the world's axes": make_travel(limits),
        "a turn on its arc": make_turn(ONE, turned(0.4), turned(1.0), bound=1e-9),
        "a turn nearly half round": make_turn(ONE, turned(0.0, 3.0), turned(1.0), bound=3.0 * (1 + 1e-12)),
        "a turn aside": make_turn(ONE, turned(0.5, 0.2), turned(1.0), bound=0.2 * (1 + 1e-9)),
        "a leg that begins before its arc by little": _begin_before(1e-12),
        "a turn beyond its arc": make_turn(ONE, turned(1.2), turned(1.0), bound=0.2 * (1 + 1e-9)),
        "a turn before its arc": make_turn(ONE, turned(-0.2), turned(1.0), bound=0.2 * (1 + 1e-9)),
        "a small jump of the way": make_hop(1e-9),
        "a small jump of the way after a spike": make_way_spike(1e-6),
        **{name: laws[name] for name in laws},
    }


def _begin_before(by: float) -> Document:
    """A second leg that begins at speed, by little before its start: aside of no arc, and tolerated there."""
    law = _strip(list_path_laws()["near the arcs"])
    here, there = (law["segments"][1][key] for key in ("start", "end"))
    raised = {"segments__1__limits__deviation": lambda bound: bound * (1 + 1e-9)}
    moved = unit([x - by * (y - x) for x, y in zip(here, there, strict=True)])
    return _with(law, limits=FREE, segments__1__pieces__0__control__0=moved, **raised)


def _break_limits() -> Iterator[Broken]:
    laws = list_path_laws()
    for index in (0, 1):
        near = {f"segments__{index}__limits__deviation": lambda bound: bound * (1 - 1e-10)}
        yield "P5", f"the deviation of leg {index} by 1e-10", _with(_strip(laws["near the arcs"]), **near)
    for angle in (1.2, -0.2):
        bound = 0.2 * (1 - 1e-9)
        yield (
            "P5",
            f"a turn by {angle} beside its arc",
            make_turn(ONE, turned(angle), turned(1.0), bound=bound),
        )
    yield "P5", "a turn aside", make_turn(ONE, turned(0.5, 0.2), turned(1.0), bound=0.2 * (1 - 1e-9))
    half = ONE, turned(0.0, pi), turned(1.0)
    yield "P5", "a turn half round by 1e-9", make_turn(*half, bound=pi - 1e-9)
    yield "P5", "a turn half round by an ulp", make_turn(*half, bound=nextafter(pi, 0))
    nearly = ONE, turned(0.0, 3.0), turned(1.0)
    yield "P5", "a turn nearly half round", make_turn(*nearly, bound=3.0 * (1 - 1e-14))
    name = "linear_velocity"
    yield "P5", "the origin's velocity by 1e-10", _lower(laws["a joint that is passed"], name, 1e-10)
    yield "P5", "its acceleration by 1e-10", _lower(laws["there and back"], "linear_acceleration", 1e-10)
    yield (
        "P5",
        "its acceleration along z",
        _lower(laws["curves and a dwell"], "linear_acceleration__2", 1e-10),
    )
    own = {"segments__0__limits__linear_velocity__1": lambda bound: bound * (1 - 1e-10)}
    yield "P5", "its velocity on one segment", _with(_strip(laws["a curve in pieces"]), **own)


def _strip(law: Document) -> Document:
    return {key: value for key, value in law.items() if key not in ("certificate", "nodes")}


def _break_nodes() -> Iterator[Broken]:
    laws = list_path_laws()
    yield "P3", "a gap of the way", _with(make_travel(), **_shift("segments__2__pieces__0__points", 1e-8))
    yield "P3", "a dwell elsewhere", _with(make_travel(), segments__1__point__2=1e-8)
    inner = _shift("segments__0__pieces__1__points", 1e-8) | {"segments__1__point__0": 2 + 1e-8}
    later = _shift("segments__2__pieces__0__points", 1e-8)
    yield "P3", "a gap of the way between pieces", _with(halve_travel(make_travel()), **inner, **later)
    last = len(laws["round"]["segments"]) - 1
    ends = {
        f"segments__{last}__end": _turn_aside(0.7e-9),
        f"segments__{last}__pieces__0__control__-1": _turn_aside(0.7e-9),
    }
    yield "P3", "a round that does not close", _with(_strip(laws["round"]), limits=FREE, continuity=0, **ends)
    there = make_travel()
    there |= {"segments": there["segments"][:1], "duration": 4.0}
    back = _with(
        there, segments__0__pieces__0__control=lambda c: [*c[:3], c[3], *c[2::-1]], segments__0__end=ONE
    )
    yield "P3", "a round whose way does not close", back | {"periodic": True}


def _break_continuity() -> Iterator[Broken]:
    laws = list_path_laws()
    yield "P6", "a round that is none", {k: v for k, v in _strip(laws["round"]).items() if k != "periodic"}
    bent = {"segments__0__pieces__0__control__1": lambda q: [x + 1e-6 for x in q]}
    yield "P6", "a round that is entered aside", _with(_strip(laws["round"]), limits=FREE, **bent)
    yield (
        "P6",
        "a way that starts at speed",
        _with(make_travel({"velocity": 2.0}), segments__0__pieces__0__points__1__0=1.1),
    )
    yield "P6", "a jump of the way's acceleration", make_hop(1e-5)
    yield "P6", "a jump of the way behind a brief leg", make_brief(1e-4)
    yield "P6", "a jump of the way behind a spike", make_way_spike(1e-3)
    yield "P6", "a limit of acceleration where velocity jumps", _jump_under_limit()
    two = halve_travel(make_travel({"velocity": 2.0}))
    yield (
        "P6",
        "a jump of the way between pieces",
        _with(two, **_bend("segments__0__pieces__1__points__1", 1e-7)),
    )
    loose = make_hop(1e-5)
    loose["limits"] = {**FREE, "linear_acceleration": 1e9}
    yield "P6", "a jump of the way under a limit far above", loose


def _bend(path: str, by: float) -> dict[str, Any]:
    return {path: lambda point: [x + by for x in point]}


def _jump_under_limit() -> Document:
    """Velocity jumps under a limit on the acceleration; nothing more is asked for."""
    law = make_travel({"velocity": 2.0, "linear_acceleration": 1e3}, continuity=0)
    law["segments"][2]["pieces"][0]["points"][1] = [2.0, 1.5, 0.0]
    return law


def _falsify() -> Iterator[Broken]:
    law, near = (
        list_path_laws()["a joint that is passed"],
        record(make_turn(ONE, turned(1.2), turned(1.0), bound=0.3)),
    )
    yield "P8", "the class of a way", _with(law, certificate__translation__continuity=3)
    jump = {"certificate__translation__nodes__1__jump__jerk": lambda size: size * (1 + 1e-8)}
    yield "P8", "a jump of a way", _with(law, **jump)
    yield (
        "P8",
        "a node of a way left out",
        _with(law, certificate__translation__nodes=lambda nodes: nodes[1:]),
    )
    yield (
        "P8",
        "a maximum of the origin's velocity",
        _with(law, certificate__limits__2__upper=lambda u: u * (1 - 2e-9)),
    )
    yield (
        "P8",
        "a maximum of a deviation",
        _with(near, certificate__limits__1__upper=lambda u: u * (1 + 2e-9)),
    )


def list_broken_paths() -> list[Broken]:
    """All of them; a law may break two promises at once."""
    parts = (_break_limits, _break_nodes, _break_continuity, _falsify)
    return [one for part in parts for one in part()]
