"""Continuity at the nodes and inside the segments: which rates jump, and by how much."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
    nodes = _list_nodes(law, scales)
    inside = _find_largest_inside(law.edges, scales)
    order = min([_class(inside), *(node.continuity for node in nodes)])
    worst = {k: max([inside[k], *(node.parts[k] for node in nodes)]) for k in range(1, order + 1)}
    return Continuity(
        nodes, _class(inside), dict(zip(RATES, law.find_largest().tolist(), strict=True)), worst
    )


def _find_largest_inside(edges: Sequence[Edges], scales: Mapping[int, JumpScale]) -> dict[int, float]:
    """The largest jump of each rate inside segments, in parts of its scale."""
    jumps = np.concatenate([e.jumps for e in edges], axis=1)
    segment = np.repeat(np.arange(len(edges)), [e.jumps.shape[1] for e in edges])
    parts = {k: scale.relate(jumps[k - 1], segment) for k, scale in scales.items()}
    return {k: float(np.max(found, initial=0.0)) for k, found in parts.items()}


def _list_nodes(law: QuaternionLaw, scales: Mapping[int, JumpScale]) -> tuple[NodeReport, ...]:
    sides = np.stack([edges.sides for edges in law.edges], axis=2)  # (4, 2, n, 3)
    first, last = (np.stack([law.outside(k, end) for k in RATES])[:, None] for end in (0, -1))
    before, after = np.concatenate([first, sides[:, 1]], axis=1), np.concatenate([sides[:, 0], last], axis=1)
    jumps = after - before
    count = len(law.segments)
    neighbours = np.maximum(np.arange(count + 1) - 1, 0), np.minimum(np.arange(count + 1), count - 1)
    parts = np.stack([_compare_sides(scales[k], jumps[k - 1], neighbours, np.minimum) for k in RATES])
    moving = _compare_sides(scales[1], before[0], neighbours, np.maximum) > JUMP_TOLERANCE
    sizes = np.linalg.norm(jumps, axis=-1)
    return tuple(
        _report_node(law, index, before[:, index], after[:, index], *own)
        for index, own in enumerate(zip(sizes.T.tolist(), parts.T.tolist(), moving.tolist(), strict=True))
    )


def _compare_sides(
    scale: JumpScale, rates: Array, neighbours: tuple[NDArray[np.int64], ...], choose: np.ufunc
) -> Array:
    """Rates (n+1, 3) at the nodes in parts (n+1,) of their scale before or after, as is chosen."""
    return np.asarray(choose(*(scale.relate(rates, segment) for segment in neighbours)))


def _report_node(
    law: QuaternionLaw,
    index: int,
    before: Array,
    after: Array,
    sizes: Sequence[float],
    parts: Sequence[float],
    moving: bool,
) -> NodeReport:
    last = law.segments[index - 1] if index else None
    following = law.segments[index] if index < len(law.segments) else None
    kind, turn = _kind(last, following, moving=moving)
    found = dict(zip(RATES, parts, strict=True))
    names = RATES.values()
    return NodeReport(
        law.labels[index],
        float(law.times[index]),
        kind,
        turn,
        dict(zip(names, before, strict=True)),
        dict(zip(names, after, strict=True)),
        dict(zip(names, sizes, strict=True)),
        found,
        _class(found),
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
