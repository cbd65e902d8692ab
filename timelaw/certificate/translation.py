"""The way of the body's origin: whether it goes on at nodes and breaks, and which of its rates jump there."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from timelaw.certificate.geometry_check import GeometryCheck
from timelaw.certificate.jump_scale import BRIEF, JUMP_TOLERANCE, LOOSE, find_floor, find_mean_time
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array

COUNTED = 3  # times that rounding counts in P/|Q|²: once in P, twice in Q
NAMES = {1: "velocity", 2: "acceleration", 3: "jerk", 4: "snap"}  # of the origin, in the world
LIMITS = {1: "linear_velocity", 2: "linear_acceleration"}
PLACE_TOLERANCE = 1e-9  # of the farthest place from the world's origin
LINEAR_ORDERS = tuple(NAMES)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)


@dataclass(frozen=True)
class Crossing:
    """A node: the gap [m], jumps of the origin's rates by order, and in parts of what they are judged by."""

    label: str
    time: float
    gap: float
    jump: Mapping[int, float]
    parts: Mapping[int, float]
    continuity: int


@dataclass(frozen=True)
class Translation:
    """All nodes, the class inside the segments; `size` [m] is the farthest place, `gap` [m] the worst gap.

    The origin is at rest before the motion and after it, or where that is periodic at its other end.
    """

    nodes: tuple[Crossing, ...]
    inside: int
    size: float
    gap: float
    where: str

    @property
    def order(self) -> int:
        """C^k of the origin's way: its place and first k rates do not jump."""
        return min(self.inside, *(node.continuity for node in self.nodes))

    @property
    def check(self) -> GeometryCheck:
        """Whether the way has no gap."""
        worst = self.gap / self.size if self.size else self.gap
        name, unit = "the origin's way has no gap", "of the farthest place"
        return GeometryCheck(name, float(worst), PLACE_TOLERANCE, self.where, unit)

    def to_dict(self) -> dict[str, Any]:
        """As the law file has it."""
        nodes = [
            {"label": node.label, "jump": {NAMES[k]: size for k, size in node.jump.items()}}
            for node in self.nodes
        ]
        return {"continuity": self.order, "continuity_inside_segments": self.inside, "nodes": nodes}


def check_translation(law: QuaternionLaw) -> Translation | None:
    """Compare the two sides of every node and break; None for a body that only turns.

    A jump counts if it is above 1e-9 of the limit on that rate, or where there is none, or one far above, of
    what the motion sustains: the largest mean over a leg; and above what places that are rounded at their
    distance from the world's origin, and Q, resolve, in differences over a 500th of a mean leg.
    """
    if not law.travels:
        return None
    size = max(float(np.max(np.linalg.norm(_places(segment, 0), axis=1))) for segment in law.segments)
    scales = {k: _scale(law, k, size) for k in LINEAR_ORDERS}
    inside = dict.fromkeys(LINEAR_ORDERS, 0.0)
    gaps = [(0.0, law.segments[0].name)]
    for segment in law.segments:
        for order in (0, *LINEAR_ORDERS):
            worst = float(np.max(np.linalg.norm(_jumps_inside(segment, order), axis=1), initial=0.0))
            if order:
                inside[order] = max(inside[order], _divide(worst, scales[order]))
            else:
                gaps.append((worst, segment.name))
    nodes = tuple(_cross(law, index, scales) for index in range(len(law.segments) + 1))
    gaps += [(node.gap, f"node {node.label}") for node in nodes]
    gap, where = max(gaps, key=lambda found: found[0] if found[0] == found[0] else np.inf)
    return Translation(nodes, _class(inside), size, gap, where)


def _places(segment: Segment, order: int) -> Array:
    """Values (m, 3) at Gauss-Legendre nodes of all parts on which no spike stands for the whole."""
    breaks = segment.even_breaks
    tau = (breaks[:-1, None] + np.diff(breaks)[:, None] * (NODES + 1) / 2).ravel()
    return segment.place(tau, order, "right")


def _scale(law: QuaternionLaw, order: int, size: float) -> float:
    """What a jump is judged by, never less than what the rounding of places makes of it."""
    leg_time = find_mean_time(law)
    means = [0.0]
    for leg in law.legs:
        weights = (np.diff(leg.even_breaks)[:, None] * WEIGHTS / 2).ravel()
        part = min(leg.duration / (BRIEF * leg_time), 1.0)  # a brief leg may be a spike
        means.append(part * float(weights @ np.linalg.norm(_places(leg, order), axis=1)))
    floor = float(find_floor(leg_time, order, COUNTED * size))
    sustained = max(*means, floor)
    bounds = [np.min(s[LIMITS[order]]) for s in _all_limits(law) if LIMITS.get(order) in s]
    return max(float(min([LOOSE * sustained, *bounds])), floor) if bounds else sustained


def _all_limits(law: QuaternionLaw) -> Iterator[Mapping[str, Any]]:
    yield law.limits
    for segment in law.segments:
        yield segment.limits


def _jumps_inside(segment: Segment, order: int) -> Array:
    """(p-1, 3) where pieces meet."""
    breaks = segment.breaks[1:-1]
    return segment.place(breaks, order, "right") - segment.place(breaks, order, "left")


def _cross(law: QuaternionLaw, index: int, scales: Mapping[int, float]) -> Crossing:
    before, after = _look(law, index - 1, 1.0), _look(law, index, 0.0)
    gap = 0.0 if before is None or after is None else float(np.linalg.norm(after[0] - before[0]))
    still = np.zeros((1 + len(LINEAR_ORDERS), 3))
    steps = (still if after is None else after) - (still if before is None else before)
    jump = {order: float(np.linalg.norm(steps[order])) for order in LINEAR_ORDERS}
    parts = {order: _divide(size, scales[order]) for order, size in jump.items()}
    return Crossing(law.labels[index], float(law.times[index]), gap, jump, parts, _class(parts))


def _look(law: QuaternionLaw, index: int, tau: float) -> Array | None:
    """Place and rates in a segment; None outside of a motion that does not go round."""
    if not (law.periodic or 0 <= index < len(law.segments)):
        return None
    segment, at = law.segments[index % len(law.segments)], np.array([tau])
    return np.stack([segment.place(at, order, "right")[0] for order in (0, *LINEAR_ORDERS)])


def _divide(size: float, scale: float) -> float:
    return 0.0 if size == 0 else size / scale if scale else float("inf")


def _class(parts: Mapping[int, float]) -> int:
    """Number of leading rates that do not jump."""
    order = 0
    for k, part in sorted(parts.items()):
        if not part <= JUMP_TOLERANCE:  # not a number is a jump too
            break
        order = k
    return order


def list_linear_jumps(law: QuaternionLaw, translation: Translation) -> list[str]:
    """Limits of the origin's rates that cannot hold, for a lower rate jumps."""
    highest = max((k for k, name in LIMITS.items() for s in _all_limits(law) if name in s), default=0)
    if translation.order >= highest - 1:
        return []
    rate = NAMES[translation.order + 1]
    worst = max(translation.nodes, key=lambda node: node.jump[translation.order + 1])
    place = f"at node {worst.label}" if worst.continuity == translation.order else "inside a segment"
    return [f"the origin's {rate} jumps {place}, where a limit on one of its derivatives cannot hold"]
