"""Continuity at the nodes and inside the segments: which rates jump, and by how much."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.segment import RATES
from timelaw.numerics.array import Array
from timelaw.numerics.function import enclose_peaks
from timelaw.numerics.turn import SAME_AXIS, angle_between_axes

JUMP_TOLERANCE = 1e-5  # of the rate's largest value in the segments that meet; short pieces resolve no better
SMOOTH = dict.fromkeys(RATES, 0.0)  # no jump at all


@dataclass(frozen=True)
class NodeReport:
    """ω, α, jerk, snap (3,) in body axes just before and after a node, their jumps, and the class C^k.

    Before the first and after the last node the body has the rates that the law says, at rest
    unless it says so. A dwell has two nodes of its label, its beginning and its end.
    `continuity` k: orientation and its first k rates (1: ω, 2: ω and α, 3: jerk, 4: snap too) are
    continuous.
    """

    label: str
    time: float
    kind: str
    turn: float
    before: Mapping[str, Array]
    after: Mapping[str, Array]
    jump: Mapping[str, float]
    continuity: int

    @property
    def passed(self) -> bool:
        """Whether the body goes straight on there at speed."""
        return self.kind == "straight" and bool(np.any(self.before["omega"]))

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

    `scales` are the largest |ω|, |α|, |jerk| of the motion, against which jumps are judged.
    """

    nodes: tuple[NodeReport, ...]
    inside: int
    scales: tuple[float, float, float]

    @property
    def order(self) -> int:
        """C^k of the whole motion, the rest before and after it included."""
        return min(self.inside, *(node.continuity for node in self.nodes))


def check_continuity(law: QuaternionLaw) -> Continuity:
    """Compare the two sides of every node and of every break."""
    scales = _scales(law)
    around = [scales[max(i - 1, 0) : i + 1] for i in range(len(scales) + 1)]
    nodes = [
        _node(law, index, (label, time), {k: max(scale[k] for scale in near) for k in RATES})
        for index, (near, label, time) in enumerate(zip(around, law.labels, law.times, strict=True))
    ]
    inside = min(
        _class(jumps, scale)
        for segment, scale in zip(law.segments, scales, strict=True)
        for jumps in (SMOOTH, *segment.jumps())
    )
    largest = [max(scale[k] for scale in scales) for k in RATES]
    return Continuity(tuple(nodes), inside, (largest[0], largest[1], largest[2]))


def _node(
    law: QuaternionLaw, index: int, place: tuple[str, float], scales: Mapping[int, float]
) -> NodeReport:
    last = law.segments[index - 1] if index else None
    following = law.segments[index] if index < len(law.segments) else None
    before = {k: last.side(k, -1) if last else law.before.get(k, np.zeros(3)) for k in RATES}
    after = {k: following.side(k, 0) if following else law.after.get(k, np.zeros(3)) for k in RATES}
    jumps = {k: float(np.linalg.norm(after[k] - before[k])) for k in RATES}
    kind, turn = _kind(last, following)
    return NodeReport(
        place[0],
        float(place[1]),
        kind,
        turn,
        {name: before[k] for k, name in RATES.items()},
        {name: after[k] for k, name in RATES.items()},
        {name: jumps[k] for k, name in RATES.items()},
        _class(jumps, scales),
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


def _scales(law: QuaternionLaw) -> list[dict[int, float]]:
    """The largest value of each rate in each segment."""
    places = [(i, k, rate) for i, s in enumerate(law.segments) for k in RATES for rate in s.rates(k)]
    scales = [dict.fromkeys(RATES, 0.0) for _ in law.segments]
    tops = enclose_peaks([rate for _, _, rate in places])
    for (index, order, _), peak in zip(places, tops, strict=True):
        scales[index][order] = max(scales[index][order], peak.lower)
    return scales


def _class(jumps: Mapping[int, float], scales: Mapping[int, float]) -> int:
    """Number of leading rates whose jump is below the tolerance."""
    order = 0
    for k in RATES:
        if not jumps[k] <= JUMP_TOLERANCE * scales[k]:  # not a number is a jump too
            break
        order = k
    return order
