"""Laws that break one promise each, by hand: what a verifier has to find."""

from collections.abc import Callable, Iterator
from math import cos, nextafter, sin
from typing import Any

from tests.exact.documents import X, arc, document, piece, quintic
from tests.exact.handmade import (
    LIMITS,
    PEAK_ACCELERATION,
    PEAK_SPEED,
    Y,
    change,
    make_arcs,
    make_body_law,
    make_dwells,
    make_jump,
    make_law,
    make_pieces,
    make_there_and_back,
)

Document = dict[str, Any]
Broken = tuple[str, str, Document]  # promise, what breaks it, the law

CANCELLING = [
    [0.9291662928876872, -0.7721159701749979, 0.02698400237329507],
    [-0.7721159701749979, 1.9, 0.0],
    [0.02698400237329507, 0.0, 1.9],
]  # (J n)_x of ASLANT is 5.7e-17; summed in doubles it is half that, with the other sign
BODY = {"inertia": [[3.0, 0.0, 0.0], [0.0, 2.5, 0.0], [0.0, 0.0, 2.0]]}
WHEELS = {**BODY, "actuator": "wheels", "momentum": [0.0, 0.0, 1.0]}


def _set(path: str, value: Any) -> Callable[[Document], None]:
    """Sets what is at the end of a path of keys and places."""

    def alter(data: Any) -> None:
        *way, last = [int(key) if key.lstrip("-").isdigit() else key for key in path.split(".")]
        for key in way:
            data = data[key]
        data[last] = value(data[last]) if callable(value) else value

    return alter


def _with(law: Document, **paths: Any) -> Document:
    """Several settings, keys joined by double underscores."""
    for path, value in paths.items():
        law = change(law, _set(path.replace("__", "."), value))
    return law


def _lengthen(by: float) -> Callable[[list[float]], list[float]]:
    return lambda vector: [x * (1 + by) for x in vector]


def _turn_aside(angle: float) -> Callable[[list[float]], list[float]]:
    """A quaternion turned on S³ by an angle in its first two components."""
    c, s = cos(angle), sin(angle)
    return lambda q: [c * q[0] - s * q[1], s * q[0] + c * q[1], *q[2:]]


def list_tolerable() -> dict[str, Document]:
    """Laws that are off by what is tolerated, or nearly."""
    late = _with(make_law(), segments__1__start_time=1 + 2 * 2.0**-52)
    aside = _with(make_law(), segments__0__end=_turn_aside(0.15e-9), segments__1__start=_turn_aside(-0.1e-9))
    short = make_body_law({"torque": [1e3, 1e3, 1e3]}, BODY, [1 - 0.9e-9, 0.0, 0.0])
    rod = make_body_law({"torque": 1e3}, {"inertia": [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1e-9]]}, X)
    filled = _with(make_law(), segments__1__duration=1 + 0.9e-12, duration=2 + 0.9e-12)
    return {"2 ulp late": late, "aside": aside, "a short axis": short, "a thin rod": rod, "filled": filled}


def break_units() -> Iterator[Broken]:
    """P1."""
    yield "P1", "a long axis", _with(make_law(), segments__0__axis=_lengthen(2e-9))
    yield "P1", "a short start", _with(make_law(), segments__1__start=_lengthen(-2e-9))
    yield "P1", "a short dwell", _with(make_dwells(1.0), segments__1__orientation=_lengthen(-2e-9))


def break_limits() -> Iterator[Broken]:
    """P5, on what limits have in common."""
    yield "P5", "by an ulp", _with(make_law(), limits__velocity=nextafter(PEAK_SPEED, 0))
    touched = make_law(limits={**LIMITS, "velocity": [PEAK_SPEED * (1 - 0.5e-9), 10.0, 10.0]})
    yield "P5", "a short axis and a limit that it touches", _shorten(touched)
    yield "P5", "a leg of its own", _with(make_law(), segments__1__limits={"jerk": 59.0})
    twice = make_there_and_back()
    twice[0]["limits"], twice[2]["limits"] = {"velocity": 2.0}, {"velocity": 0.9}
    yield "P5", "the slower of two legs of one name", document(twice, dict(LIMITS), continuity=2)
    spike = make_pieces()
    tiny = [piece(1e-30, [0.5, 1.0, 0.0], [600.0]), piece(1e-30, [0.5, 1.0, 6e-28], [-600.0])]
    spike["segments"][0]["pieces"][1:1] = tiny
    yield "P5", "a spike of jerk of 1e-30 s", spike


def _shorten(law: Document) -> Document:
    return _with(law, segments__0__axis=_lengthen(-0.9e-9))


def break_body_limits() -> Iterator[Broken]:
    """P5, on torque and momentum."""
    free = [1e6, 1e6]
    wheels = {"inertia": CANCELLING, "actuator": "wheels"}
    torque = make_body_law({"torque": [4e-17 * PEAK_ACCELERATION, *free]}, wheels)
    yield "P5", "torque where J n cancels", torque
    momentum = make_body_law({"momentum": [4e-17 * PEAK_SPEED, *free]}, {"inertia": CANCELLING})
    yield "P5", "momentum where J n cancels", momentum
    # 3 φ'' and 3.5 φ'² at right angles: neither alone is more than 17.33
    yield "P5", "gyroscopic torque", make_body_law({"torque": 17.0}, BODY, X)
    both = make_body_law({"torque": 3 * PEAK_ACCELERATION + 1e-3}, WHEELS, X)
    yield "P5", "torque of wheels whose momentum counts", both
    full = make_body_law({"momentum": 3 * PEAK_SPEED + 0.999}, WHEELS, X)
    yield "P5", "momentum of wheels that have some before", full
    axis = make_body_law({"torque": 3 * PEAK_ACCELERATION * (1 - 0.5e-9)}, BODY, X)
    yield "P5", "torque about a short axis", _shorten(axis)


def break_nodes() -> Iterator[Broken]:
    """P3: parts that are each tolerable, and add up."""
    part = 0.4e-9
    sums = _with(
        make_dwells(1.0),
        segments__0__angle=lambda angle: angle + part,
        segments__1__orientation=_turn_aside(-part / 2),
        segments__2__pieces__0__state__0=part,
        segments__2__angle=lambda angle: angle + part,
    )
    yield "P3", "an arc, a dwell and a start that add up", sums
    aside = _with(make_dwells(1.0), segments__0__end=_turn_aside(0.3e-9))
    aside = _with(aside, segments__1__orientation=_turn_aside(0.6e-9), segments__2__start=_turn_aside(0.3e-9))
    yield "P3", "an arc's end and a dwell that add up", aside
    yield "P3", "0.8e-9 on S³", _with(make_law(), segments__1__start=_turn_aside(0.8e-9))
    yield "P3", "0.8e-9 on S³ at the end", _with(make_law(), segments__1__end=_turn_aside(0.8e-9))
    gaps = make_pieces()
    for k, one in enumerate(gaps["segments"][0]["pieces"]):
        one["state"][0] += 0.9e-10 * k
    gaps["segments"][0]["angle"] += 12 * 0.9e-10
    yield "P3", "gaps between pieces that add up", gaps
    drift = make_dwells(1.0, 1.0, 1.0)
    for k in (1, 2, 3):
        drift = _with(drift, **{f"segments__{k}__orientation": _turn_aside(k * 0.2e-9)})
    yield "P3", "dwells that drift away", drift
    flipped = _with(make_law(), segments__1__start=lambda q: [-x for x in q])
    yield "P3", "a joint of q and -q", _with(flipped, segments__1__end=lambda q: [-x for x in q])
    yield "P3", "an arc to -q", _with(make_law(), segments__1__end=lambda q: [-x for x in q])
    yield "P3", "labels of neighbours", _with(make_law(), segments__1__from="3")
    yield "P3", "a start within the first arc", _with(make_law(), segments__0__pieces__0__state__0=-1.1e-9)


def break_times() -> Iterator[Broken]:
    """P4."""
    early = make_dwells(9e11, time=1000.0)
    yield (
        "P4",
        "a leg that starts early after a long dwell",
        _with(early, segments__2__start_time=9e11 + 999.5),
    )
    yield "P4", "a clock that does not resolve a leg", make_dwells(9e11)
    yield "P4", "a start that is not 0", _with(make_law(), segments__0__start_time=1e-13)
    yield "P4", "a start 3 ulp late", _with(make_law(), segments__1__start_time=1 + 3 * 2.0**-52)
    yield (
        "P4",
        "pieces that do not fill a leg",
        _with(make_law(), segments__1__duration=1 + 2e-12, duration=2 + 2e-12),
    )
    yield "P4", "another duration", _with(make_law(), duration=2 * (1 + 2e-12))


def _begin_with(a: float) -> Callable[[Document], Document]:
    """The same quintic turn, but with an acceleration at its start."""
    return lambda _: piece(1.0, [0.0, 0.0, a], [60 - 9 * a, -120 + 9 * a, 60 - 3 * a])


def break_continuity() -> Iterator[Broken]:
    """P6: jumps, in the open and behind larger rates elsewhere."""
    yield "P6", "a jump", make_jump(1e-6)
    yield "P6", "a jump at a node", _with(make_law(), segments__1__pieces__0=_begin_with(1e-6))
    spiked = make_jump(0.5)
    h, speed = 1e-20, 1e29 * 1e-40  # up to 1e9 rad/s² and back, which adds `speed`
    up = piece(h, [0.5, 1.0 - speed, 0.0], [1e29])
    down = piece(h, [0.5, 1.0 - speed / 2, 1e9], [-1e29])
    spiked["segments"][0]["pieces"][1:1] = [up, down]
    spiked["segments"][0]["pieces"][0]["bernstein"][0] -= 2 * speed
    yield "P6", "a jump behind a spike in a piece", spiked
    brief = arc("1", "2", [quintic(1e-9, 1e-9)], angle=1e-9)
    yield "P6", "a jump behind a brief segment", make_jump(0.5, brief)
    own = make_jump(0.5, *make_arcs())
    own["segments"][0]["limits"] = {"acceleration": 1e9}
    yield "P6", "a jump behind another leg's own limit", own
    yield "P6", "more asked for", _with(make_law(), continuity=3)
    yield (
        "P6",
        "a limit of jerk where acceleration jumps",
        _with(make_jump(0.5), continuity=0, limits=dict(LIMITS)),
    )
    moving = make_law(outside={"before": {"omega": [1e-7, 0.0, 0.0]}})
    yield "P6", "a start from moving", moving


def break_bodies() -> Iterator[Broken]:
    """P7."""
    for what, inertia in {
        "a moment more than the others": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.1]],
        "a little more than the others": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2 + 1e-8]],
        "no symmetry": [[1.0, 1e-8, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        "a negative moment": [[1.0, 1.5, 0.0], [1.5, 1.0, 0.0], [0.0, 0.0, 1.0]],
        "no inertia": [[0.0, 0.0, 0.0]] * 3,
    }.items():
        yield "P7", what, make_body_law({"torque": 100.0}, {"inertia": inertia}, Y)


def list_broken() -> list[Broken]:
    """All of them but for records."""
    parts = (
        break_units,
        break_limits,
        break_body_limits,
        break_nodes,
        break_times,
        break_continuity,
        break_bodies,
    )
    return [one for part in parts for one in part()]
