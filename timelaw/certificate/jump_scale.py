"""What a jump of a rate is judged against: the limit of its order, or what the motion sustains of it.

A peak would do instead of what is sustained, if nobody could hide a jump behind a spike of a microsecond.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.limits.row import ORDERS
from timelaw.motion import QuaternionLaw
from timelaw.motion.segment import RATES
from timelaw.numerics.array import Array

JUMP_TOLERANCE = 1e-9  # of the scale
ROUNDING = 4 * float(np.finfo(float).eps)  # of numbers: differences of two, on both sides of a jump
FINE = 500.0  # parts of a mean leg: differences over them are the shortest that rounded numbers resolve
BRIEF = 1e-3  # of the mean leg; what is shorter counts for as much: a leg of its own may be a spike
LOOSE = 1e3  # times what is sustained: a limit above that says nothing about jumps


@dataclass(frozen=True)
class JumpScale:
    """Bounds on one rate of each segment: on its norm (n,), and by axis (n, 3) where there are any."""

    norm: Array
    axes: Array | None

    def relate(self, jumps: Array, segment: NDArray[np.int64]) -> Array:
        """Jumps (m, 3) in these segments (m,), in parts (m,) of the bound that is the tightest for each."""
        parts = _divide(np.linalg.norm(jumps, axis=-1), self.norm[segment])
        if self.axes is not None:
            by_axis = _divide(np.abs(jumps), self.axes[segment])
            parts = np.maximum(parts, np.max(by_axis, axis=-1))
        return parts


def list_scales(law: QuaternionLaw) -> dict[int, JumpScale]:
    """For each order of a rate the scales of all segments.

    The limits of that order, the law's and the segment's own, unless they are far above what the motion
    sustains of the rate; where there is none, that itself: the largest mean size over a leg, at least the
    largest mean ω over the (k-1)-th power of the whole duration, for in a steady turn all else is rounding.
    Where rates are read off rounded quaternions, never less than what these resolve.
    """
    names = {order: name for name, order in ORDERS.items()}
    mean_time = find_mean_time(law)
    fineness = np.array([segment.fineness for segment in law.segments])
    means = dict(zip(RATES, _sustain(law, BRIEF * mean_time).tolist(), strict=True))
    return {
        k: _choose(
            law,
            names[k],
            max(means[k], float(means[1] / np.power(law.duration, k - 1.0))),
            find_floor(mean_time, k, 1.0, fineness),
        )
        for k in RATES
    }


def find_floor(mean_time: float, order: int, size: float, fineness: Array | float = FINE) -> Array:
    """The scale of which the tolerance is what rounding shows of the k-th derivative of numbers of a size.

    As if every leg were one of the mean time [s]: a brief one may be a spike.
    """
    fine = np.minimum(fineness, FINE) / mean_time
    return np.asarray(ROUNDING * size * fine**order / JUMP_TOLERANCE)


def find_mean_time(law: QuaternionLaw) -> float:
    """Of a leg [s]; the whole duration where there is none."""
    legs = [leg.duration for leg in law.legs]
    return float(np.mean(legs)) if legs else law.duration


def _choose(law: QuaternionLaw, name: str, sustained: float, floor: Array) -> JumpScale:
    """The tightest of the law's bound and each segment's own, none below its floor (n,)."""
    norm = np.full(len(law.segments), np.inf)
    axes = np.full((len(law.segments), 3), np.inf)
    for number, segment in enumerate(law.segments):
        for given in (law.limits.get(name), segment.limits.get(name)):
            if given is not None:
                bounds = axes if isinstance(given, tuple) else norm
                bounds[number] = np.minimum(bounds[number], given)
    limited = np.isfinite(norm) | np.isfinite(axes[:, 0])
    norm = np.minimum(norm, np.where(limited, LOOSE * sustained, sustained))
    by_axis = np.maximum(axes, floor[:, None]) if np.any(np.isfinite(axes)) else None
    return JumpScale(np.maximum(norm, floor), by_axis)


def _sustain(law: QuaternionLaw, brief: float) -> Array:
    """The largest mean size of each rate (4,) over a leg, one shorter than `brief` [s] counted as that."""
    legs = [(s.duration, edges.sums) for s, edges in zip(law.segments, law.edges, strict=True) if s.moves]
    if not legs:
        return np.zeros(len(RATES))
    times = np.maximum([time for time, _ in legs], brief)
    return np.asarray(np.max(np.array([sums for _, sums in legs]) / times[:, None], axis=0))


def _divide(size: Array, bound: Array) -> Array:
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(size == 0, 0.0, size / bound)
