"""Where the search begins: a clamped spline through the nodes, as slow as the limits ask for."""

from collections.abc import Sequence
from itertools import pairwise
from math import inf
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import conjugate, multiply
from timelaw.through.curve import Curve, make_curve
from timelaw.through.rate_limits import RateLimits, find_stretch

QUINTIC_PEAKS = (15 / 8, 10 / 3**0.5, 60.0)  # of f', f'', f''': in which time a leg would be made alone


def align_signs(quaternions: Array) -> Array:
    """Quaternions (n, 4) with neighbours' signs alike, so that the way between them is the shorter one."""
    signs = np.sign(np.sum(quaternions[1:] * quaternions[:-1], axis=1))
    return np.array(
        quaternions * np.cumprod(np.concatenate([[1.0], np.where(signs < 0, -1.0, 1.0)]))[:, None]
    )


def begin(nodes: Array, stops: Sequence[int], limits: RateLimits, degree: int) -> Curve:
    """A curve of one piece a leg through nodes (n, 4) within the limits, at rest at both ends and `stops`."""
    turn = align_signs(nodes)
    angles = 2 * np.arccos(np.clip(np.sum(turn[1:] * turn[:-1], axis=1), -1.0, 1.0))
    bounds = [float(np.min(limits.bounds.get(k, inf))) for k in (1, 2, 3)]
    alone = [
        (peak * angles / bound) ** (1 / k)
        for k, (peak, bound) in enumerate(zip(QUINTIC_PEAKS, bounds, strict=True), 1)
    ]
    duration = np.max(alone, axis=0)
    omega, alpha = _read_spline(turn, duration, sorted({0, *stops, len(turn) - 1}))
    curve = make_curve(degree, 1, turn, omega, alpha, duration)
    return curve.stretched(float(np.max(find_stretch(curve, limits))))


def _read_spline(turn: Array, duration: Array, rests: Sequence[int]) -> tuple[Array, Array]:
    """ω and α (n, 3) at the nodes of the cubic spline in R⁴ that is at rest where it should be."""
    times = np.concatenate([[0.0], np.cumsum(duration)])
    omega, alpha = np.zeros((2, len(turn), 3))
    still: Any = (1, np.zeros(4))
    for first, last in pairwise(rests):
        spline = CubicSpline(times[first : last + 1], turn[first : last + 1], bc_type=(still, still))
        inner = slice(first + 1, last)
        q, v, a = turn[inner], spline(times[inner], 1), spline(times[inner], 2)
        omega[inner] = 2 * multiply(conjugate(q), v)[:, 1:]
        growth = 2 * np.sum(q * v, axis=1, keepdims=True)
        alpha[inner] = 2 * multiply(conjugate(q), a)[:, 1:] - growth * omega[inner]
    return omega, alpha
