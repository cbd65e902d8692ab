"""Continuity at the nodes and inside the segments: which rates jump, and by how much."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from timelaw.limits.rate import ORDERS
from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.segment import RATES
from timelaw.numerics.array import Array
from timelaw.numerics.function import enclose_peaks
from timelaw.numerics.turn import SAME_AXIS, angle_between_axes

JUMP_TOLERANCE = 1e-9  # of the limit of that order, or of the largest rate of the motion


@dataclass(frozen=True)
class NodeReport:
    """ω, α, jerk, snap (3,) in body axes just before and after a node, their jumps, and the class C^k.

    Before the first and after the last node the body has the rates that the law says, at rest
    unless it says so. A dwell has two nodes of its label, its beginning and its end.
    `continuity` k: orientation and its first k rates (1: ω, 2: ω and α, 3: jerk, 4: snap too) are
    continuous. `moving`: with a speed that is more than the rounding of rest.
    """

    label: str
    time: float
    kind: str
    turn: float
    before: Mapping[str, Array]
    after: Mapping[str, Array]
    jump: Mapping[str, float]
    continuity: int
    moving: bool

    @property
    def passed(self) -> bool:
        """Whether the body goes straight on there at speed."""
        return self.kind == "straight" and self.moving

    def to_dict(self) -> dict[str, Any]:
        """As the law file has it."""
        return {
            "label": self.label,
            "time": self.time,
            "kind": self.kind,
            "turn": self.turn,
            "jump": dict(self.jump),
            "continuity": self.continuity,
            "before": {name: v.tolist() for name, v in self.before.items()},
            "after": {name: v.tolist() for name, v in self.after.items()},
        }


@dataclass(frozen=True)
class Continuity:
    """All nodes, the class inside the segments, and the class of the whole motion.

    `peaks` are the largest |ω|, |α|, |jerk|, |snap| of the motion by order. `worst` is what rounding leaves
    of jumps in the rates that the class says are continuous, in parts of what they are judged by.
    """

    nodes: tuple[NodeReport, ...]
    inside: int
    peaks: Mapping[int, float]
    worst: Mapping[int, float]

    @property
    def order(self) -> int:
        """C^k of the whole motion, the rest before and after it included."""
        return min(self.inside, *(node.continuity for node in self.nodes))


def check_continuity(law: QuaternionLaw) -> Continuity:
    """Compare the two sides of every node and of every break, in all segments by one rule.

    A jump of the k-th rate counts if it is above 1e-9 of the limit of that order where there is one (axis by
    axis where it is given so; for limits of single legs the loosest), else of the largest k-th rate of the
    whole motion. Where that is rounding itself, as in a steady turn, the largest ω over the (k-1)-th power
    of the whole duration is what it is told by.
    """
    peaks = _peaks(law)
    scales = _scales(law, peaks)
    nodes = tuple(_node(law, index, scales) for index in range(len(law.segments) + 1))
    inside = [_relate(jumps, scales) for segment in law.segments for jumps in segment.jumps()]
    at_nodes = [_relate(_subtract(node), scales) for node in nodes]
    classes = [_class(parts) for parts in inside]
    order = min([*classes, *(node.continuity for node in nodes)])
    worst = {k: max(parts[k] for parts in (*inside, *at_nodes)) for k in range(1, order + 1)}
    return Continuity(nodes, min(classes, default=max(RATES)), peaks, worst)


def _node(law: QuaternionLaw, index: int, scales: Mapping[int, Array]) -> NodeReport:
    last = law.segments[index - 1] if index else None
    following = law.segments[index] if index < len(law.segments) else None
    before = {k: last.side(k, -1) if last else law.before.get(k, np.zeros(3)) for k in RATES}
    after = {k: following.side(k, 0) if following else law.after.get(k, np.zeros(3)) for k in RATES}
    jumps = {k: after[k] - before[k] for k in RATES}
    kind, turn = _kind(last, following)
    return NodeReport(
        law.labels[index],
        float(law.times[index]),
        kind,
        turn,
        {name: before[k] for k, name in RATES.items()},
        {name: after[k] for k, name in RATES.items()},
        {name: float(np.linalg.norm(jumps[k])) for k, name in RATES.items()},
        _class(_relate(jumps, scales)),
        _relate(before, scales)[1] > JUMP_TOLERANCE,
    )


def _kind(last: Segment | None, following: Segment | None) -> tuple[str, float]:
    """What a node is, and by how much the axis turns there."""
    if last is None or following is None:
        return ("start" if last is None else "end"), 0.0
    if not (last.moves and following.moves):
        return "dwell", 0.0
    axes = last.axis_at(-1), following.axis_at(0)
    if axes[0] is None or axes[1] is None:
        return "passed", 0.0
    turn = angle_between_axes(axes[0], axes[1])
    return ("straight" if turn <= SAME_AXIS else "corner"), turn


def _peaks(law: QuaternionLaw) -> dict[int, float]:
    """The largest value of each rate in the motion."""
    places = [(k, rate) for segment in law.segments for k in RATES for rate in segment.rates(k)]
    peaks = dict.fromkeys(RATES, 0.0)
    for (order, _), peak in zip(places, enclose_peaks([rate for _, rate in places]), strict=True):
        peaks[order] = max(peaks[order], peak.lower)
    return peaks


def _scales(law: QuaternionLaw, peaks: Mapping[int, float]) -> dict[int, Array]:
    """What a jump of each rate is judged against, () for its norm or (3,) by axis."""
    scales = {k: np.array(max(peaks[k], peaks[1] / law.duration ** (k - 1))) for k in RATES}
    for name, order in ORDERS.items():
        own = [segment.limits[name] for segment in law.legs if name in segment.limits]
        given = [law.limits[name]] if name in law.limits else own
        if given:
            scales[order] = np.array(max(given, key=np.min), dtype=float)
    return scales


def _subtract(node: NodeReport) -> dict[int, Array]:
    return {k: node.after[name] - node.before[name] for k, name in RATES.items()}


def _relate(jumps: Mapping[int, Array], scales: Mapping[int, Array]) -> dict[int, float]:
    """Each jump (3,) in parts of its scale."""
    parts = {}
    for k, scale in scales.items():
        size = np.abs(jumps[k]) if scale.ndim else np.linalg.norm(jumps[k])
        with np.errstate(divide="ignore", invalid="ignore"):
            parts[k] = float(np.max(np.where(size == 0, 0.0, size / scale)))
    return parts


def _class(parts: Mapping[int, float]) -> int:
    """Number of leading rates that do not jump."""
    order = 0
    for k in RATES:
        if not parts[k] <= JUMP_TOLERANCE:  # not a number is a jump too
            break
        order = k
    return order
