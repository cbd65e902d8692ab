"""Continuity at the nodes and inside the segments: which rates jump, and by how much."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from timelaw.certificate.jump_scale import JUMP_TOLERANCE, JumpScale, list_scales
from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.segment import RATES, Edges
from timelaw.numerics.array import Array
from timelaw.numerics.turn import SAME_AXIS, angle_between_axes


@dataclass(frozen=True)
class NodeReport:
    """ω, α, jerk, snap (3,) in body axes just before and after a node, their jumps, and the class C^k.

    Before the first and after the last node the body has the rates that the law says, at rest
    unless it says so. A dwell has two nodes of its label, its beginning and its end. `parts` are the jumps
    by order in parts of what they are judged by.
    `continuity` k: orientation and its first k rates (1: ω, 2: ω and α, 3: jerk, 4: snap too) are
    continuous. `moving`: with a speed that is more than the rounding of rest.
    """

    label: str
    time: float
    kind: str
    turn: float | None
    before: Mapping[str, Array]
    after: Mapping[str, Array]
    jump: Mapping[str, float]
    parts: Mapping[int, float]
    continuity: int
    moving: bool

    @property
    def passed(self) -> bool:
        """Whether the body goes on there at speed."""
        return self.kind in ("straight", "passed") and self.moving

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
    """Compare the two sides of every node and of every break.

    A jump counts if it is above 1e-9 of what `list_scales` says of its segment, at a node of the looser of
    both sides.
    """
    scales = list_scales(law)
    nodes = tuple(_node(law, index, scales) for index in range(len(law.segments) + 1))
    inside = {k: _largest_inside(law.edges, k, scales[k]) for k in RATES}
    order = min([_class(inside), *(node.continuity for node in nodes)])
    worst = {k: max([inside[k], *(node.parts[k] for node in nodes)]) for k in range(1, order + 1)}
    return Continuity(
        nodes, _class(inside), dict(zip(RATES, law.find_largest().tolist(), strict=True)), worst
    )


def _largest_inside(edges: Sequence[Edges], order: int, scales: Sequence[JumpScale]) -> float:
    """The largest jump of a rate inside segments, in parts of its scale."""
    parts = [scale.relate(e.jumps[order - 1]) for e, scale in zip(edges, scales, strict=True)]
    return float(np.max(np.concatenate(parts), initial=0.0))


def _node(law: QuaternionLaw, index: int, scales: Mapping[int, Sequence[JumpScale]]) -> NodeReport:
    last = law.segments[index - 1] if index else None
    following = law.segments[index] if index < len(law.segments) else None
    before = {k: law.edges[index - 1].sides[k - 1, -1] if last else law.outside(k, 0) for k in RATES}
    after = {k: law.edges[index].sides[k - 1, 0] if following else law.outside(k, -1) for k in RATES}
    jumps = {k: after[k] - before[k] for k in RATES}
    sides = {k: scales[k][max(index - 1, 0) : index + 1] for k in RATES}
    parts = {k: float(min(scale.relate(jumps[k]) for scale in sides[k])) for k in RATES}
    moving = any(float(scale.relate(before[1])) > JUMP_TOLERANCE for scale in sides[1])
    kind, turn = _kind(last, following, moving=moving)
    return NodeReport(
        law.labels[index],
        float(law.times[index]),
        kind,
        turn,
        {name: before[k] for k, name in RATES.items()},
        {name: after[k] for k, name in RATES.items()},
        {name: float(np.linalg.norm(jumps[k])) for k, name in RATES.items()},
        parts,
        _class(parts),
        moving,
    )


def _kind(last: Segment | None, following: Segment | None, *, moving: bool) -> tuple[str, float | None]:
    """What a node is, and by how much the axis turns there, where there is one on both sides."""
    if last is None or following is None:
        return ("start" if last is None else "end"), 0.0
    if not (last.moves and following.moves):
        return "dwell", 0.0
    axes = last.axis_at(-1), following.axis_at(0)
    if axes[0] is None or axes[1] is None:
        return ("passed" if moving else "stop"), None
    turn = angle_between_axes(axes[0], axes[1])
    return ("straight" if turn <= SAME_AXIS else "corner"), turn


def _class(parts: Mapping[int, float]) -> int:
    """Number of leading rates that do not jump."""
    order = 0
    for k in RATES:
        if not parts[k] <= JUMP_TOLERANCE:  # not a number is a jump too
            break
        order = k
    return order
