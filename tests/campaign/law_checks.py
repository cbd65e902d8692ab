"""Checks of a law by itself: file, jumps, nodes, given times, rates, limits. Each yields what is wrong."""

import json
from collections.abc import Iterator

import numpy as np

from tests.campaign.attitude import about, apart, inverse, product
from tests.campaign.bounds import used_parts
from tests.campaign.evidence import CHEBYSHEV, NODES, WEIGHTS, Evidence
from tests.campaign.legs import sets_on
from tests.campaign.spec import number
from timelaw.certificate import certify
from timelaw.errors import InputError
from timelaw.law_file.document import from_document, to_document

JUMP = 1e-9  # of the limit of that order
MEETS = 1e-9  # rad
ON_TIME = 1e-9  # relative
EXCEEDS = 1e-9  # of a limit, beside what sampling cannot resolve
AGREES = 1e-6  # of the rate that is integrated


def file_reads_back(e: Evidence) -> Iterator[str]:
    """Written, read and verified again: the same certificate."""
    text = json.dumps(to_document(e.law), allow_nan=False)
    try:
        again = certify(from_document(json.loads(text)))
    except InputError as error:
        yield f"law file: cannot be read back: {error.faults[0]}"
        return
    if again.to_dict() != e.design.optimised.certificate.to_dict():
        yield "law file: another certificate after it is read back"


def nothing_jumps(e: Evidence) -> Iterator[str]:
    """Rates are continuous up to the order asked for."""
    for order in range(1, e.spec.continuity + 1):
        worst = max((jump for jump in e.jumps if jump[1] == order), default=(0.0, 0, ""))
        if not worst[0] <= JUMP:
            yield f"jump: rate {order} by {worst[0]:.3g} of its scale {worst[2]}"


def order_is_kept(e: Evidence) -> Iterator[str]:
    """The visits are those of the tour."""
    spec, labels = e.spec, e.labels
    if spec.searched:
        once = labels[:-1] if spec.closed else labels
        if sorted(once) != sorted(e.points) or (spec.closed and labels[0] != labels[-1]):
            yield f"order: {labels} does not visit each orientation once"
        return
    given = spec.tour if isinstance(spec.tour, list) else list(e.points)
    if labels != ([*given, given[0]] if spec.closed else given):
        yield f"order: {labels} instead of {given}"


def nodes_are_met(e: Evidence) -> Iterator[str]:
    """At its time each orientation, from both sides, and all along a dwell."""
    tolerance = MEETS + e.spec.precision
    for label, (arrived, left) in zip(e.labels, e.visits, strict=True):
        t = np.linspace(arrived, left, 5) if left > arrived else np.array([arrived])
        for side in ("left", "right"):
            off = float(np.max(apart(np.asarray(e.law(t, 0, side)), e.points[label])))
            if not off <= tolerance:
                yield f"node {label}: off by {off:.3g} rad at t = {arrived:.9g}"
        inner = t[1:-1]
        if len(inner) and any(np.any(np.asarray(e.law(inner, k))) for k in (1, 2, 3, 4)):
            yield f"dwell at {label}: the body moves"


def arcs_are_kept(e: Evidence) -> Iterator[str]:
    """Between the nodes the body turns about the leg's axis alone, which digits tell the worse the farther beyond."""
    precision = e.spec.precision * (1 + e.beyond)
    for leg, (_, left), (arrived, _) in zip(e.legs, e.visits, e.visits[1:], strict=False):
        t = np.linspace(left, arrived, 17)[1:-1]
        d = product(inverse(e.points[leg.origin]), np.asarray(e.law(t)))[:, 1:]
        aside = float(np.max(np.linalg.norm(d - (d @ leg.axis)[:, None] * leg.axis, axis=1))) * 2
        if not aside <= 4 * MEETS + 2 * precision:
            yield f"leg {leg.origin}-{leg.target}: {aside:.3g} rad beside the arc"


def times_are_kept(e: Evidence) -> Iterator[str]:
    """Dwells, arrivals, durations, the total."""
    spec, law = e.spec, e.law
    total = float(law.times[-1])
    wanted = [(f"dwell at {label}", left - arrived, spec.dwell(label, k, len(e.labels)), total * 1e-12)
              for k, (label, (arrived, left)) in enumerate(zip(e.labels, e.visits, strict=True))]  # fmt: skip
    for k, label in enumerate(e.labels):
        if "time" in spec.nodes.get(label, {}) and (k or not spec.closed):
            time = number(spec.nodes[label]["time"])
            wanted.append((f"arrival at {label}", e.visits[k][0], time, time * ON_TIME))
    for k, leg in enumerate(e.legs):
        rule = spec.legs.get(f"{leg.origin}-{leg.target}", {})
        if "duration" in rule:
            time = number(rule["duration"])
            wanted.append(
                (
                    f"{leg.origin}-{leg.target}",
                    e.visits[k + 1][0] - e.visits[k][1],
                    time,
                    time * ON_TIME + total * 1e-13,
                )
            )
    if spec.total_time is not None:
        wanted.append(("total time", total, spec.total_time, spec.total_time * ON_TIME))
    for what, found, given, tolerance in wanted:
        if not abs(found - given) <= tolerance:
            yield f"time: {what} is {found:.12g} s, not {given:.12g} s"


def stops_are_kept(e: Evidence) -> Iterator[str]:
    """Where a stop is demanded, or a dwell, ω is zero on both sides."""
    for k, (label, (arrived, left)) in enumerate(zip(e.labels, e.visits, strict=True)):
        if not (0 < k < len(e.labels) - 1) or not (e.spec.nodes.get(label, {}).get("stop") or left > arrived):
            continue
        speed = max(
            float(np.linalg.norm(e.law(t, 1, side))) for t, side in ((arrived, "left"), (left, "right"))
        )
        if not speed <= JUMP * e.scale[1]:
            yield f"stop at {label}: ω = {speed:.3g} rad/s"


def rates_belong_together(e: Evidence) -> Iterator[str]:
    """q turns by the integral of ω, and each rate changes by the integral of the next, piece by piece."""
    worst = dict.fromkeys(range(4), 0.0)
    clock = {k: 4 * np.finfo(float).eps * float(e.law.times[-1]) * e.largest[k + 1] for k in worst}
    for a, b in ((0.0, 0.5), (0.5, 1.0), (0.1, 0.3)):
        ends, inside = e.sampled(np.array([a, b])), e.sampled(a + (b - a) * (NODES + 1) / 2)
        for piece, now, within in zip(e.pieces, ends, inside, strict=True):
            lasts = float(np.diff(e.inside(piece, np.array([a, b])))[0])
            for k in worst:
                change = (WEIGHTS / 2 * lasts) @ within[k + 1]
                if not k and e.spec.through:  # about no one axis: q' = ½ q ⊗ ω
                    pure = np.concatenate([np.zeros((len(NODES), 1)), within[1]], axis=1)
                    turned = (WEIGHTS / 2 * lasts) @ product(within[0], pure) / 2
                    off = 2 * float(np.linalg.norm(now[0][1] - now[0][0] - turned))
                else:
                    off = (
                        float(np.linalg.norm(now[k][1] - now[k][0] - change))
                        if k
                        else _turned_off(now[0], change)
                    )
                off -= clock[k] + (e.resolution(piece, k) if k else 0.0)
                worst[k] = max(worst[k], off / (e.largest[k] if k else 1.0) if off > 0 else 0.0)
    for k, off in worst.items():
        if not off <= AGREES:
            yield f"rates: order {k + 1} is not the derivative of order {k}, by {off:.3g} of its size"


def _turned_off(ends: np.ndarray, change: np.ndarray) -> float:
    """Angle between where `change`, a turn about one axis, leads from the first end, and the second."""
    angle = float(np.linalg.norm(change))
    if angle >= np.pi:
        return 0.0
    return float(apart(product(ends[0], about(change / (angle or 1.0), np.array(angle))), ends[1]))


def limits_are_held(e: Evidence) -> Iterator[str]:
    """Dense samples of the vectors against each limit, general ones and those of legs."""
    worst: dict[str, tuple[float, float]] = {}
    moving = [i for i, s in enumerate(e.law.segments) if s.moves]
    for piece, sample in zip(e.pieces, e.samples, strict=True):
        if piece.segment not in moving:
            continue
        segment = e.law.segments[piece.segment]
        for limits in sets_on(e.spec, segment.origin, segment.target):
            for name, parts in used_parts(limits, e.spec.body, sample, sample[0], e.samples[0][0][0]).items():
                top = int(np.argmax(parts))
                blur = _blur(e, piece, name, limits[name])
                over = float(parts[top]) - blur
                if over > worst.get(name, (0.0, 0.0))[0]:
                    worst[name] = over, piece.start + CHEBYSHEV[top] * (piece.end - piece.start)
    for name, (over, t) in worst.items():
        if not over <= 1 + EXCEEDS:
            yield f"limit: {name} {over:.12g} times its bound at t = {t:.9g}"


def _blur(e: Evidence, piece, name: str, bound) -> float:
    """Of the limit, what a sample cannot resolve."""
    if name in ("torque", "momentum"):
        size = float(np.linalg.norm(e.spec.body.inertia))
        return size * e.resolution(piece, 2 if name == "torque" else 1) / float(np.min(bound)) + 1e-10
    order = {"velocity": 1, "acceleration": 2, "jerk": 3, "snap": 4}[name]
    return e.resolution(piece, order) / float(np.min(bound))


LAW_CHECKS = (
    file_reads_back,
    nothing_jumps,
    order_is_kept,
    nodes_are_met,
    arcs_are_kept,
    times_are_kept,
    stops_are_kept,
    rates_belong_together,
    limits_are_held,
)
