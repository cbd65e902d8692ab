"""Continuity at the nodes and inside the segments: which rates jump, and by how much."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from timelaw.limits import Rate
from timelaw.motion import Arc, QuaternionLaw
from timelaw.numerics.extrema import peaks
from timelaw.route.leg import AXIS_TOLERANCE, turn_between

Array = NDArray[np.float64]

RATES = {1: "omega", 2: "alpha", 3: "jerk"}
JUMP_TOLERANCE = 1e-6  # of the largest value of that rate in the law; control points resolve no better


@dataclass(frozen=True)
class NodeReport:
    """ω, α, jerk (3,) in body axes just before and after a node, their jumps, and the class C^k.

    Before the first and after the last node the body is at rest. `continuity` k: orientation and
    its first k rates (1: ω, 2: ω and α, 3: jerk too) are continuous.
    """

    label: str
    time: float
    kind: str
    turn: float
    before: Mapping[str, Array]
    after: Mapping[str, Array]
    jump: Mapping[str, float]
    continuity: int

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


def continuity(law: QuaternionLaw) -> Continuity:
    """Compare the two sides of every node and of every break."""
    scales = {k: _scale(law, k) for k in RATES}
    nodes = [_node(law, index, scales) for index in range(len(law.segments) + 1)]
    inside = min(_class(jumps, scales) for s in law.segments for jumps in _break_jumps(s))
    return Continuity(tuple(nodes), inside, (scales[1], scales[2], scales[3]))


def _node(law: QuaternionLaw, index: int, scales: Mapping[int, float]) -> NodeReport:
    last = law.segments[index - 1] if index else None
    following = law.segments[index] if index < len(law.segments) else None
    before, after = (_side(last, -1), _side(following, 0))
    jumps = {k: float(np.linalg.norm(after[k] - before[k])) for k in RATES}
    turn = turn_between(last.axis, following.axis) if last and following else 0.0
    if last is None or following is None:
        kind = "start" if last is None else "end"
    else:
        kind = "straight" if turn <= AXIS_TOLERANCE else "corner"
    return NodeReport(
        law.labels[index],
        float(law.times[index]),
        kind,
        turn,
        {name: before[k] for k, name in RATES.items()},
        {name: after[k] for k, name in RATES.items()},
        {name: jumps[k] for k, name in RATES.items()},
        _class(jumps, scales),
    )


def _side(segment: Arc | None, end: int) -> dict[int, Array]:
    """Rates at the first (0) or last (-1) instant of a segment, of no segment zero."""
    if segment is None:
        return {k: np.zeros(3) for k in RATES}
    return {
        k: segment.angle / segment.duration**k * segment.easing.derivative(k)[end][0][end] * segment.axis
        for k in RATES
    }


def _break_jumps(segment: Arc) -> list[dict[int, float]]:
    """Jumps of the travelled angle's rates at the breaks inside a segment; none counts as smooth."""
    rates = {k: segment.rates(k) for k in RATES}
    jumps = [dict.fromkeys(RATES, 0.0)]
    for left, right in pairwise(range(len(segment.easing.pieces))):
        jumps.append({k: abs(float(r[right][0][0] - r[left][0][-1])) for k, r in rates.items()})
    return jumps


def _scale(law: QuaternionLaw, order: int) -> float:
    """The largest value of a rate in the motion."""
    limit = Rate(RATES[order], order, 1.0)
    rows = [limit.rows({order: c})[0].value for s in law.segments for c, _ in s.rates(order)]
    return max(peak.lower for peak in peaks(rows))


def _class(jumps: Mapping[int, float], scales: Mapping[int, float]) -> int:
    """Number of leading rates whose jump is below the tolerance."""
    order = 0
    for k in RATES:
        if jumps[k] > JUMP_TOLERANCE * scales[k]:
            break
        order = k
    return order
