"""SciPy's RotationSpline through the same nodes: what a user has without this program, as fast as it may be.

Its ω and α are continuous, its jerk jumps, and it moves at both ends. It is sampled, not proved.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from timelaw.limits import make_limits
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array

SAMPLES = 400  # of each leg
STEP = 1e-4  # of a leg, over which α is differenced


@dataclass(frozen=True)
class Sampled:
    """Its time [s], and how fast [rad/s] it moves at both ends."""

    duration: float
    ends: tuple[float, float]


def time_rotation_spline(law: QuaternionLaw) -> Sampled | None:
    """Through the nodes of a law, at its instants, slower or faster by one factor: as the limits allow.

    None where the body rests on its way, a limit asks for the snap, or a total momentum makes limits that are
    not homogeneous.
    """
    from scipy.spatial.transform import Rotation, RotationSpline

    limits = make_limits(law.limits, law.body)
    rests = len(law.legs) < len(law.segments)
    if rests or any(limit.highest > 3 for limit in limits) or any(law.total_momentum):
        return None
    times = np.array([segment.start_time for segment in law.legs] + [law.legs[-1].end_time])
    nodes = np.array([*(segment.start for segment in law.legs), law.legs[-1].end])
    spline = RotationSpline(times, Rotation.from_quat(np.roll(nodes, -1, axis=1)))
    factor = 0.0
    for first, last in pairwise(times.tolist()):
        rates = _sample(spline, first, last)
        for limit in limits:
            vector = np.stack(np.broadcast_arrays(*limit.vector(rates)), axis=-1)
            sizes = np.abs(vector) if isinstance(limit.bounds, tuple) else np.linalg.norm(vector, axis=-1)
            factor = max(factor, float(np.max(sizes / np.array(limit.bounds))) ** (1 / limit.power))
    ends = np.linalg.norm(spline(times[[0, -1]], 1), axis=1) / factor
    return Sampled(factor * float(times[-1] - times[0]), (float(ends[0]), float(ends[1])))


def _sample(spline: Any, first: float, last: float) -> dict[int, Sequence[Array]]:
    """ω, α and jerk (3) in body axes at places of one leg, from inside."""
    step = STEP * (last - first)
    t = np.linspace(first + step, last - step, SAMPLES)
    jerk = (spline(t + step, 2) - spline(t - step, 2)) / (2 * step)
    return {k: list(vector.T) for k, vector in enumerate((spline(t, 1), spline(t, 2), jerk), 1)}
