"""What a jump of a rate is judged against: the limit of its order, or what the motion sustains of it.

A peak would do instead of what is sustained, if nobody could hide a jump behind a spike of a microsecond.
"""

from dataclasses import dataclass

import numpy as np

from timelaw.limits.row import ORDERS
from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.segment import RATES
from timelaw.numerics.array import Array

JUMP_TOLERANCE = 1e-9  # of the scale
ROUNDING = 4 * float(np.finfo(float).eps)  # of numbers: differences of two, on both sides of a jump
FINE = 500.0  # parts of a mean leg: differences over them are the shortest that rounded numbers resolve
BRIEF = 1e-3  # of the mean leg; what is shorter counts for as much: a leg of its own may be a spike
LOOSE = 1e3  # times what is sustained: a limit above that says nothing about jumps


@dataclass(frozen=True)
class JumpScale:
    """Bounds on one rate of a segment, () on its norm or (3,) by axis; all of them count."""

    bounds: tuple[Array, ...]

    def relate(self, jumps: Array) -> Array:
        """Jumps (..., 3) in parts (...) of the bound that is the tightest for them."""
        return np.asarray(np.max([_divide(jumps, bound) for bound in self.bounds], axis=0))


def list_scales(law: QuaternionLaw) -> dict[int, list[JumpScale]]:
    """For each order of a rate the scale of each segment.

    The limits of that order, the law's and the segment's own, unless they are far above what the motion
    sustains of the rate; where there is none, that itself: the largest mean size over a leg, at least the
    largest mean ω over the (k-1)-th power of the whole duration, for in a steady turn all else is rounding.
    Where rates are read off rounded quaternions, never less than what these resolve.
    """
    names = {order: name for name, order in ORDERS.items()}
    slowest = _sustain(law, 1)
    found = {}
    for k in RATES:
        sustained = np.array(max(_sustain(law, k), slowest / np.power(law.duration, k - 1.0)))
        found[k] = [
            _choose(law, segment, names[k], sustained, find_floor(law, k, 1.0, segment.fineness))
            for segment in law.segments
        ]
    return found


def find_floor(law: QuaternionLaw, order: int, size: float, fineness: float = FINE) -> float:
    """The scale of which the tolerance is what rounding shows of the k-th derivative of numbers of a size.

    As if every leg were a mean one: a brief one may be a spike.
    """
    return ROUNDING * size * (min(fineness, FINE) / find_mean_time(law)) ** order / JUMP_TOLERANCE


def find_mean_time(law: QuaternionLaw) -> float:
    """Of a leg [s]; the whole duration where there is none."""
    return float(np.mean([leg.duration for leg in law.legs])) if law.legs else law.duration


def _choose(law: QuaternionLaw, segment: Segment, name: str, sustained: Array, floor: float) -> JumpScale:
    given = tuple(np.array(part[name]) for part in (law.limits, segment.limits) if name in part)
    bounds = (*given, LOOSE * sustained) if given else (sustained,)
    return JumpScale(tuple(np.maximum(bound, floor) for bound in bounds))


def _sustain(law: QuaternionLaw, order: int) -> float:
    """The largest mean size of a rate over a leg."""
    brief = BRIEF * find_mean_time(law)
    legs = [(s.duration, edges) for s, edges in zip(law.segments, law.edges, strict=True) if s.moves]
    return max((float(edges.sums[order - 1]) / max(time, brief) for time, edges in legs), default=0.0)


def _divide(jumps: Array, bound: Array) -> Array:
    size = np.abs(jumps) if bound.ndim else np.linalg.norm(jumps, axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = np.where(size == 0, 0.0, size / bound)
    return np.max(parts, axis=-1) if bound.ndim else np.asarray(parts)
