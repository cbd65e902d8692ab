"""Motions along Bézier curves: what is true of their laws."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import inf
from typing import Any

import numpy as np

from tests.campaign import least
from tests.campaign.bounds import used_parts
from tests.campaign.curve_motion import Sample, sample_piece
from tests.campaign.curve_path import path_is_followed
from tests.campaign.curve_spec import Bezier, classify, read_curves
from tests.campaign.law_checks import file_reads_back
from tests.campaign.spec import RATES, Spec, leg_limits
from timelaw.law_file.document import to_document

CHEBYSHEV = (1 - np.cos(np.linspace(0, np.pi, 17))) / 2
LINEAR = {"linear_velocity": 1, "linear_acceleration": 2}
FOLLOWS = 1e-7  # rad, and of the farthest place
PLACES, GRID = (
    24,
    1601,
)  # of a leg, at which the curve is looked for; of the curve, where it is looked for first
EXCEEDS = 1e-8  # of a limit; samples in doubles resolve no less
JUMP = 1e-7  # of a rate's scale
AGREES = 1e-6
ROUNDED, FINE = 4e-15, 500  # of a place; parts of a leg
SLOWER = 1e-6
FAST = 1e-4  # of a bound that quadrature finds


@dataclass(frozen=True)
class CurveEvidence:
    """A design along curves beside its problem."""

    spec: Spec
    design: Any

    @property
    def law(self):
        return self.design.optimised.law

    @cached_property
    def curves(self) -> list[Bezier]:
        """As the judge reads them."""
        return read_curves(self.spec.data)

    @cached_property
    def document(self) -> dict:
        """What the file holds."""
        return json.loads(json.dumps(to_document(self.law), allow_nan=False))

    @cached_property
    def legs(self) -> list[int]:
        """Numbers of the segments that move."""
        return [k for k, s in enumerate(self.document["segments"]) if s["kind"] != "dwell"]

    @cached_property
    def samples(self) -> list[Sample]:
        """Of every piece."""
        found = []
        for k in self.legs:
            count = len(self.document["segments"][k]["pieces"])
            found += [sample_piece(self.document, k, i, CHEBYSHEV) for i in range(count)]
        return found

    @cached_property
    def largest(self) -> dict[str, float]:
        """The largest of each rate, ω1 … and p0 …, over the motion."""
        found = {
            f"w{k}": max(float(np.max(np.linalg.norm(s.rates[k], axis=1))) for s in self.samples)
            for k in range(1, 5)
        }
        if self.samples[0].places:
            found |= {
                f"p{k}": max(float(np.max(np.linalg.norm(s.places[k], axis=1))) for s in self.samples)
                for k in range(5)
            }
        return found

    def resolve(self, rate: str) -> float:
        """What rounded quaternions and places show of a rate: differences over a small part of a mean leg."""
        size = self.largest["p0"] if rate[0] == "p" else 1.0
        time = sum(self.document["segments"][k]["duration"] for k in self.legs) / len(self.legs)
        return ROUNDED * size * (FINE / time) ** int(rate[1])

    @property
    def labels(self) -> list[str]:
        return [str(k + 1) for k in range(len(self.curves) + 1)]

    def rests(self, joint: int) -> bool:
        """Whether a rest is asked for at a node."""
        label = self.labels[joint]
        return self.spec.dwell(label, joint, len(self.labels)) > 0 or bool(
            self.spec.nodes.get(label, {}).get("stop")
        )


def law_has_the_legs(e: CurveEvidence) -> Iterator[str]:
    """One for each curve, dwells where and as long as they are asked for."""
    segments = e.document["segments"]
    wanted: list[tuple] = []
    for k, label in enumerate(e.labels):
        time = e.spec.dwell(label, k, len(e.labels))
        wanted += [("dwell", label, time)] if time else []
        wanted += [("rational", label, None)] if k < len(e.curves) else []
    found = [(s["kind"], s.get("from", s.get("at")), s["duration"]) for s in segments]
    if [one[:2] for one in found] != [one[:2] for one in wanted]:
        yield f"order: {[one[:2] for one in found]} instead of {[one[:2] for one in wanted]}"
        return
    for (_, label, time), (_, _, asked) in zip(found, wanted, strict=True):
        if asked is not None and time != asked:
            yield f"time: the dwell at {label} takes {time} s, not {asked} s"


def rates_are_those_of_the_file(e: CurveEvidence) -> Iterator[str]:
    """What the program evaluates agrees with what the file's numbers give."""
    worst: dict[str, float] = {}
    for sample in e.samples:
        inner = slice(2, -2)
        t = sample.time[inner]
        clock = 8 * np.spacing(e.law.duration)
        pairs = {f"w{k}": (np.asarray(e.law(t, k)), sample.rates[k][inner]) for k in (1, 2, 3)}
        if sample.places:
            pairs |= {f"p{k}": (np.asarray(e.law.place(t, k)), sample.places[k][inner]) for k in (0, 1, 2)}
        for name, (its, mine) in pairs.items():
            following = f"{name[0]}{int(name[1]) + 1}"
            off = float(np.max(np.linalg.norm(its - mine, axis=1))) - clock * e.largest[following]
            off -= e.resolve(name)
            worst[name] = max(worst.get(name, 0.0), off / (e.largest[name] or 1.0))
    for name, off in worst.items():
        if not off <= AGREES:
            yield f"rates: {name} is not that of the file's numbers, by {off:.3g} of its size"


def limits_are_held(e: CurveEvidence) -> Iterator[str]:
    """Dense samples against each limit, general ones and those of curves."""
    worst: dict[str, tuple[float, float]] = {}
    first = e.samples[0].q[0]
    for sample in e.samples:
        segment = e.document["segments"][sample.segment]
        for limits in leg_limits(e.spec, segment["from"], segment["to"], (False, False)):
            turning = {name: bound for name, bound in limits.items() if name not in LINEAR}
            parts = used_parts(turning, e.spec.body, sample.rates, sample.q, first)
            for name in set(limits) & set(LINEAR):
                values, bound = sample.places[LINEAR[name]], limits[name]
                by_axis = np.ndim(bound) > 0
                parts[name] = (
                    np.max(np.abs(values) / bound, axis=1)
                    if by_axis
                    else np.linalg.norm(values, axis=1) / bound
                )
            for name, used in parts.items():
                top = int(np.argmax(used))
                worst[name] = max(worst.get(name, (0.0, 0.0)), (float(used[top]), float(sample.time[top])))
    for name, (used, t) in worst.items():
        if not used <= 1 + EXCEEDS:
            yield f"limit: {name} {used:.12g} times its bound at t = {t:.9g}"


def nothing_jumps(e: CurveEvidence) -> Iterator[str]:
    """Rates of the body and of its origin up to the continuity asked for, from rest to rest."""
    ends = []  # (segment, at its end?, rates)
    for sample, following in zip([None, *e.samples], [*e.samples, None], strict=True):
        ends.append((_edge(sample, -1), _edge(following, 0), following or sample))
    for k in range(1, e.spec.continuity + 1):
        for kind in ("w", "p"):
            if f"{kind}{k}" not in e.largest:
                continue
            scale = max(e.largest[f"{kind}{k}"], _bound_of(e.spec, kind, k))
            for before, after, where in ends:
                jump = np.linalg.norm(
                    after.get(f"{kind}{k}", np.zeros(3)) - before.get(f"{kind}{k}", np.zeros(3))
                )
                if not jump <= JUMP * scale + e.resolve(f"{kind}{k}"):
                    yield f"jump: {kind}{k} by {jump / scale:.3g} of its scale in segment {where.segment}"


def _edge(sample: Sample | None, index: int) -> dict[str, np.ndarray]:
    if sample is None:
        return {}
    found = {f"w{k}": rate[index] for k, rate in sample.rates.items()}
    return found | {f"p{k}": rate[index] for k, rate in sample.places.items()}


def _bound_of(spec: Spec, kind: str, order: int) -> float:
    names = RATES if kind == "w" else LINEAR
    given = [spec.limits[name] for name, k in names.items() if k == order and name in spec.limits]
    return min((float(np.min(bound)) for bound in given), default=0.0)


def joints_are_right(e: CurveEvidence) -> Iterator[str]:
    """Their classes as they are found from the curves; the body stops where it has to, and passes where it may."""
    r = e.spec.continuity
    for k, (joint, passed) in enumerate(zip(e.design.joints, e.design.passed, strict=True)):
        parametric, geometric = classify(e.curves[k], e.curves[k + 1])
        if joint.parametric not in parametric or joint.geometric not in geometric:
            yield f"joint {k + 2}: said to be C{joint.parametric}, G{joint.geometric}, it is {parametric}, {geometric}"
        smooth = geometric.start >= r if passed else geometric.stop - 1 >= r
        rests = e.rests(k + 1)
        if passed and (rests or geometric.stop - 1 < r):
            yield f"joint {k + 2}: passed, though it should not"
        if not passed and not rests and geometric.start >= r and r <= 3 and smooth:
            yield f"joint {k + 2}: the body stops where it may pass"
        speed = float(np.linalg.norm(_edge(_last_of(e, k), -1)["w1"]))
        if not passed and not speed <= JUMP * e.largest["w1"]:
            yield f"joint {k + 2}: said to be a stop, ω = {speed:.3g} rad/s"


def _last_of(e: CurveEvidence, leg: int) -> Sample:
    return [sample for sample in e.samples if sample.segment == e.legs[leg]][-1]


def quintic_is_no_faster(e: CurveEvidence) -> Iterator[str]:
    """The law is not slower than the quintic with a stop at every joint."""
    for other in e.design.baselines:
        if e.spec.continuity > 2 or not other.certificate.limits_hold or not _holds_quintic(e.spec):
            continue
        mine, its = float(e.law.duration), float(other.law.duration)
        if not mine <= its * (1 + SLOWER):
            yield f"slower than the quintic: {mine:.9g} s, {its:.9g} s"


def _holds_quintic(spec: Spec) -> bool:
    """Whether a quintic is among the easings that may be chosen."""
    return spec.degree >= 5


def nothing_is_faster_than_physics(e: CurveEvidence) -> Iterator[str]:
    """|ω| changes by no more than |α|: a path of that length from rest to rest takes so long; so for the origin."""
    rest = sum(s["duration"] for s in e.document["segments"] if s["kind"] == "dwell")
    lengths = np.sum([curve.lengths() for curve in e.curves], axis=0)
    for length, names in zip(lengths, (("velocity", "acceleration"), tuple(LINEAR)), strict=True):
        w, a = (
            float(np.linalg.norm(e.spec.limits[name])) if name in e.spec.limits else inf for name in names
        )
        if length <= 0 or min(w, a) == inf:
            continue
        bound = least.double_s(float(length), w, a, inf)
        if not e.law.duration - rest >= bound * (1 - FAST):
            yield f"too fast: {e.law.duration - rest:.9g} s, {names[0]} and its change allow {bound:.9g} s"


def look_at_curves(evidence: CurveEvidence) -> Iterator[str]:
    """All that is wrong with a law along curves."""
    yield from file_reads_back(evidence)
    wrong = list(law_has_the_legs(evidence))
    yield from wrong
    for check in CHECKS if not wrong else ():
        yield from check(evidence)


CHECKS = (
    path_is_followed,
    rates_are_those_of_the_file,
    limits_are_held,
    nothing_jumps,
    joints_are_right,
    quintic_is_no_faster,
    nothing_is_faster_than_physics,
)
