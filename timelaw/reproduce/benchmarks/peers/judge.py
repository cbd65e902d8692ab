"""What a motion does, judged from its orientations alone, by finite differences: no code of any designer.

At an instant t the body turns by φ(s) against where it is, q(t)* ⊗ q(t + s), so that with φ(0) = 0
ω = φ', α = φ'', jerk = φ''' - ½ φ'×φ''. Differences over ±2h are averages of what is between, with weights
that are positive: they never say more than there is, but for rounding; at a peak beside a node less, by what
the rate changes within four steps (0.5 % of the quintic's jerk).
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.spatial.transform import Rotation

from timelaw.numerics.array import Array
from timelaw.reproduce.benchmarks.peers.motion import Course, Motion

STEPS = 5000  # of the fine grid, for each leg on average
STRIDE = 2  # steps over which is differenced
JUMPING = 1.6  # differences over half as far: so much larger where the rate below jumps, twice in the limit
AT_REST = 0.01  # of the greatest |ω|


@dataclass(frozen=True)
class Verdict:
    """Total time [s]; the largest |ω|, |α|, |jerk| in parts of their limits.

    `jumping` is the order of the rate that jumps, if one does, `resting` at how many nodes the body rests,
    `deviation` [rad] how far it is from the arc at most.
    """

    duration: float
    used: tuple[float, float, float]
    jumping: int | None
    resting: int
    deviation: float


def judge_motion(motion: Motion, course: Course, each: int = STEPS) -> Verdict:
    """Judge a motion on a grid of `each` steps for each leg."""
    duration = float(motion.times[-1])
    steps = each * (len(course.nodes) - 1)
    t = np.linspace(0.0, duration, steps + 1)
    h = duration / steps
    q = motion.evaluate(t)
    used = _largest(q, STRIDE, h) / course.limits
    nearer = _largest(q, 1, h) / course.limits
    growing = [order for order in (2, 3) if nearer[order - 1] > JUMPING * max(used[order - 1], 1.0)]
    return Verdict(
        duration,
        (float(used[0]), float(used[1]), float(used[2])),
        growing[0] - 1 if growing else None,
        _count_rests(motion, course, h),
        _deviate(motion, course, t, q),
    )


def difference(q: Array, stride: int, h: float) -> tuple[Array, Array, Array]:
    """ω, α, jerk (m, 3) in body axes, of orientations (m + 4·stride, 4) at steps of h [s]."""
    rotations = [
        Rotation.from_quat(q[k * stride : len(q) - (4 - k) * stride], scalar_first=True) for k in range(5)
    ]
    back = rotations[2].inv()
    far_before, before, _, after, far_after = ((back * other).as_rotvec() for other in rotations)
    step = stride * h
    first = (after - before) / (2 * step)
    second = (after + before) / step**2  # φ(0) = 0
    third = (far_after - 2 * after + 2 * before - far_before) / (2 * step**3)
    return first, second, third - np.cross(first, second) / 2


def _largest(q: Array, stride: int, h: float) -> Array:
    """The largest of the norms (3,)."""
    return np.array([np.max(np.linalg.norm(rate, axis=1)) for rate in difference(q, stride, h)])


def _count_rests(motion: Motion, course: Course, h: float) -> int:
    """At how many nodes |ω| is a hundredth of its limit or less, just before and just after."""
    slow = 0
    for time in motion.times:
        near = np.clip([time - h, time, time + h], 0.0, motion.times[-1])
        turns = Rotation.from_quat(motion.evaluate(near), scalar_first=True)
        slow += bool(np.all((turns[:-1].inv() * turns[1:]).magnitude() <= AT_REST * course.limits[0] * h))
    return slow


def _deviate(motion: Motion, course: Course, t: Array, q: Array) -> float:
    """The largest angle [rad] between the body and the arc of its leg, at the nodes too."""
    most = 0.0
    at_nodes = motion.evaluate(motion.times)
    for k, (start, end) in enumerate(pairwise(course.nodes)):
        inside = (t > motion.times[k]) & (t < motion.times[k + 1])
        here = np.vstack([at_nodes[k : k + 1], q[inside], at_nodes[k + 1 : k + 2]])
        across = end - (end @ start) * start
        across /= np.linalg.norm(across)
        angle = np.arctan2(end @ across, end @ start)
        along = np.arctan2(here @ across, here @ start)
        along = np.where(along < -np.pi / 2, along + np.pi, np.where(along > np.pi / 2, along - np.pi, along))
        along = np.clip(along, 0.0, angle)[:, None]
        nearest = np.cos(along) * start + np.sin(along) * across
        apart = Rotation.from_quat(nearest, scalar_first=True).inv() * Rotation.from_quat(
            here, scalar_first=True
        )
        most = max(most, float(np.max(apart.magnitude())))
    return most
