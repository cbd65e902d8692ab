"""How far a curve leaves the arcs of its legs, as the search sees it.

With u₁, u₂ across the arc and e along it where one of its ends is passed, the sine of half the angle δ of
the body to the closed arc is |(e·Q, u₁·Q, u₂·Q)|/|Q|: of power 0, for slowness does not change it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from timelaw.limits.formula import Vector, dot4
from timelaw.numerics.arc_frame import frame_arc
from timelaw.numerics.array import Array
from timelaw.through.dual import value_of
from timelaw.through.kinematics import States

INSIDE = 1e-3  # of the bound, by which the search keeps from it: no stretch mends what is beyond


@dataclass(frozen=True)
class DeviationMeasure:
    """`bounds` (K, 1) on sin(δ/2); `first`, `last` (K, 4) and `across` (K, 2, 4) frame the arcs."""

    bounds: Array
    first: Array
    last: Array
    across: Array
    power: ClassVar[int] = 0
    highest: ClassVar[int] = 0
    stretches: ClassVar[bool] = True

    def vector(self, q: States, rates: Mapping[int, Vector], h: Any, legs: Any) -> Vector:  # noqa: ARG002
        """(e·Q, u₁·Q, u₂·Q)/|Q|, e·Q being zero between the planes at the arc's ends."""
        point = q[0]
        over = dot4(point, point) ** -0.5
        before, beyond = (_along(point, ends[legs]) for ends in (self.first, self.last))
        passed = before * (value_of(before) < 0) + beyond * (value_of(beyond) > 0)
        aside = (_along(point, self.across[legs, k]) for k in range(2))
        return [part * over for part in (passed, *aside)]


def _along(q: Vector, vectors: Array) -> Any:
    return dot4(q, list(np.moveaxis(vectors, -1, 0)))


def limit_deviation(turn: Array, bound: float | Sequence[float]) -> DeviationMeasure:
    """At most `bound` [rad], for all legs or each (K,), between nodes (K+1, 4)."""
    frames = [frame_arc(a, b) for a, b in pairwise(turn)]
    angles = np.broadcast_to(np.asarray(bound, dtype=float), len(frames))
    return DeviationMeasure(
        np.sin(angles / 2)[:, None] * (1 - INSIDE),
        np.stack([frame.first for frame in frames]),
        np.stack([frame.last for frame in frames]),
        np.stack([frame.across for frame in frames]),
    )
