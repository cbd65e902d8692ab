"""Smoothsteps: the polynomial of least degree with r derivatives zero at both ends.

r = 2 is the law of [MMB2017], 6τ⁵ - 15τ⁴ + 10τ³, which is also the minimum-jerk law; r = 3 the
septic 35τ⁴ - 84τ⁵ + 70τ⁶ - 20τ⁷. In Bernstein form: r + 1 zeros, then r + 1 ones.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from timelaw.easing.easing import Easing, Timing
from timelaw.limits import Rate
from timelaw.numerics.bernstein import differentiate, evaluate, split
from timelaw.numerics.extrema import peaks

Array = NDArray[np.float64]

BISECTIONS = 60  # halvings of [0, 1]: the last bit of a double


def smoothstep(continuity: int) -> Array:
    """Control points (2r+2,) of the smoothstep with r = `continuity` zero derivatives."""
    return np.repeat([0.0, 1.0], continuity + 1)


def least_duration(control: Array, angle: float, limits: Sequence[Rate]) -> float:
    """Least T [s] for a polynomial easing over θ: max over limits of (θ max|f^(k)|/bound)^(1/k).

    For the quintic, whose derivatives peak at 15/8, 10/√3 and 60:
    T = max(1.875 θ/w, √(5.7735 θ/a), ∛(60 θ/j)).
    """
    tops = peaks([differentiate(control, limit.order) for limit in limits])
    return max(
        limit.stretch(angle * top.lower / limit.bound) for limit, top in zip(limits, tops, strict=True)
    )


def leg_timing(angle: float, limits: Sequence[Rate], continuity: int) -> Timing:
    """The smoothstep over one leg, from stop to stop, in its least time."""
    control = smoothstep(continuity)
    return Timing(least_duration(control, angle, limits), Easing.single(control))


def run_timings(angles: Sequence[float], limits: Sequence[Rate], continuity: int) -> tuple[Timing, ...]:
    """One smoothstep over a whole run, in its least time, cut at the nodes it passes."""
    control, total = smoothstep(continuity), float(sum(angles))
    duration = least_duration(control, total, limits)
    timings: list[Timing] = []
    rest, travelled = control, 0.0
    for angle in angles[:-1]:
        share = _solve_monotone(rest, (travelled + angle) / total)
        piece, rest = split(rest, share)
        timings.append(Timing(duration * share, _normalised(piece)))
        duration *= 1 - share
        travelled += angle
    return (*timings, Timing(duration, _normalised(rest)))


def _normalised(piece: Array) -> Easing:
    """Shift and scale control points so that they run from exactly 0 to exactly 1."""
    control = (piece - piece[0]) / (piece[-1] - piece[0])
    control[0], control[-1] = 0.0, 1.0
    return Easing.single(control)


def _solve_monotone(control: Array, value: float) -> float:
    """U with p(u) = value, for an increasing polynomial on [0, 1]."""
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if float(evaluate(control, middle)) < value else (low, middle)
    return (low + high) / 2
