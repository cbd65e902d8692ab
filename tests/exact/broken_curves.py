"""Laws with rational segments that break one promise each, or just none, by hand."""

from collections.abc import Iterator
from itertools import pairwise
from math import comb
from typing import Any

from numpy.polynomial.legendre import leggauss

from tests.exact.broken import WHEELS, Broken, _lengthen, _turn_aside, _with
from tests.exact.curve_laws import list_curve_laws, make_rest, piece
from tests.exact.documents import ONE, arc, document, rational
from tests.exact.documents import piece as arc_piece
from tests.exact.handmade import follow

Document = dict[str, Any]

END = [0.8, 0.36, 0.48, 0.0]
LIMITS = {"velocity": 2.0, "acceleration": 5.0, "jerk": 40.0}
SPIKE = 1e-4  # of the length of Q elsewhere


def make_curve(limits: Document | None = None, together: int = 3, **others: Any) -> Document:
    """One rational segment from rest to rest."""
    legs = [rational("1", "2", [make_rest(ONE, END, together, 2.0)])]
    return document(legs, limits or dict(LIMITS), **{"continuity": 2, **others})


def make_two_pieces() -> Document:
    """The same law with the same curve in two pieces, the second of which is twice as large."""
    law = make_curve()
    c, left, right = [p[:] for p in law["segments"][0]["pieces"][0]["control"]], [], []
    while c:
        left.append(c[0])
        right.insert(0, [2 * x for x in c[-1]])
        c = [[(x + y) / 2 for x, y in zip(a, b, strict=True)] for a, b in pairwise(c)]
    law["segments"][0]["pieces"] = [piece(1.0, left), piece(1.0, right)]
    return law


def make_spike(jump: float) -> Document:
    """A segment on which Q comes near zero for a moment, then an arc whose acceleration jumps.

    The moment is a place at which quadrature with 24 nodes looks.
    """
    u, n = float(leggauss(24)[0][12] + 1) / 2, 10
    points = [[1.0, 0.0, 0.0, 0.0]] * 4 + [[0.5 - 0.5 * i, 0.0, 0.0, 0.0] for i in range(3)]
    points += [[-1.0, 0.0, 0.0, 0.0]] * 4
    weights = [comb(n, i) * u**i * (1 - u) ** (n - i) for i in range(n + 1)]
    rest = sum(w * p[0] for i, (w, p) in enumerate(zip(weights, points, strict=True)) if i != 5)
    points[5] = [-rest / weights[5], SPIKE / weights[5], 0.0, 0.0]
    spike = rational("1", "2", [piece(1.0, points)])
    first, second = [arc_piece(1.0, [0.0] * 3, [6.0, -6.0])], [0.5, 1.0, jump]
    first.append(arc_piece(1.0, second, [-6.0 - 4 * jump, 6.0 + 2 * jump]))
    leg = arc("2", "3", first, angle=1 + jump / 12, start=spike["end"])
    return document(follow(spike, leg), {"velocity": 1e9}, continuity=2)


def list_tolerable_curves() -> dict[str, Document]:
    """Laws that are off by what is tolerated, or not at all."""
    aside = _with(make_curve(), segments__0__start=_turn_aside(0.2e-9), segments__0__end=_turn_aside(-0.1e-9))
    away = _with(
        make_two_pieces(), segments__0__pieces__1__control=lambda c: [[x * 1e5 for x in q] for q in c]
    )
    return {
        "a curve": make_curve(),
        "a curve aside": aside,
        "two pieces": make_two_pieces(),
        "a piece far away": away,
        "a small jump after a spike": make_spike(1e-7),
        **list_curve_laws(),
    }


def _lower(law: Document, name: str, by: float) -> Document:
    """A limit that was touched, lower."""
    law = {key: value for key, value in law.items() if key not in ("certificate", "nodes")}
    return _with(law, **{f"limits__{name}": lambda bound: bound * (1 - by)})


def _break_limits() -> Iterator[Broken]:
    laws = list_curve_laws()
    yield "P5", "the velocity of curves by 1e-10", _lower(laws["curves"], "velocity", 1e-10)
    yield "P5", "the jerk of curves by 1e-10", _lower(laws["curves"], "jerk", 1e-10)
    yield "P5", "the torque of curves by 1e-10", _lower(laws["torque of curves"], "torque", 1e-10)
    yield "P5", "the snap of a curve by 1e-10", _lower(laws["a smooth curve"], "snap", 1e-10)
    yield "P5", "curves beside arcs by 1e-10", _lower(laws["arcs and curves"], "jerk", 1e-10)
    yield "P5", "momentum that turns", _lower(laws["wheels on curves"], "momentum__1", 1e-10)
    own = _with(make_curve(), segments__0__limits={"jerk": 1.0})
    yield "P5", "a curve's own limit", own
    brief = make_curve({"snap": 1e18}, together=4, continuity=3, duration=1e-9)
    spike = make_rest(ONE, END, 4, 2.8e-28)
    spike["control"] = [[x * 1e6 for x in point] for point in spike["control"]]
    brief["segments"][0] |= {"pieces": [spike, piece(1e-9, [END] * 2)], "duration": 1e-9}
    yield "P5", "a piece of 1e-28 s", brief
    yield "P5", "wheels that hold a curve", make_curve({"torque": 1.2}, body=WHEELS)


def _break_nodes() -> Iterator[Broken]:
    yield "P1", "a short start of a curve", _with(make_curve(), segments__0__start=_lengthen(-2e-9))
    yield "P2", "a curve through zero", _through_zero()
    yield "P3", "a curve that starts aside", _with(make_curve(), segments__0__start=_turn_aside(0.6e-9))
    yield "P3", "a curve to -q", _with(make_curve(), segments__0__end=lambda q: [-x for x in q])
    control = "segments__0__pieces__1__control"
    yield "P3", "a piece of -Q", _with(make_two_pieces(), **{control: lambda c: [[-x for x in q] for q in c]})
    turned = {control: lambda c: [_turn_aside(0.6e-9)(q) for q in c], "segments__0__end": _turn_aside(0.6e-9)}
    yield "P3", "a gap between pieces of a curve", _with(make_two_pieces(), **turned)
    yield (
        "P4",
        "a curve whose pieces are short",
        _with(make_curve(), segments__0__pieces__0__duration=2 - 4e-12),
    )


def _through_zero() -> Document:
    law = make_curve({"velocity": 1e9})
    law["segments"][0] |= {"end": [-1.0, 0.0, 0.0, 0.0]}
    law["segments"][0]["pieces"] = [piece(2.0, [ONE] * 3 + [[-x for x in ONE]] * 3)]
    return law


def _break_continuity() -> Iterator[Broken]:
    yield "P6", "more asked for of a curve", make_curve(continuity=3)
    yield "P6", "a curve of cubics", make_curve({"velocity": 2.0}, together=2)
    control = "segments__0__pieces__1__control__2"
    bent = _with(make_two_pieces(), **{control: lambda q: [x + 1e-7 for x in q]})
    yield "P6", "a point after a joint", bent
    yield "P6", "a jump behind a spike of Q", make_spike(1e-3)


def _falsify() -> Iterator[Broken]:
    law = list_curve_laws()["curves"]
    yield "P8", "a maximum of a curve", _with(law, certificate__limits__2__upper=lambda u: u * (1 + 2e-9))
    yield "P8", "the class of a curve", _with(law, certificate__continuity=3)
    yield "P8", "the time of a passed node", _with(law, nodes__1__time=lambda t: t * (1 + 1e-8))


def list_broken_curves() -> list[Broken]:
    """All of them; a law may break two promises at once."""
    parts = (_break_limits, _break_nodes, _break_continuity, _falsify)
    return [one for part in parts for one in part()]
