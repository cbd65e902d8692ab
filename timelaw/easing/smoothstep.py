"""Smoothsteps: the polynomial of least degree with r derivatives zero at both ends.

r = 2 is the law of [MMB2017], 6τ⁵ - 15τ⁴ + 10τ³, which is also the minimum-jerk law; r = 3 the
septic 35τ⁴ - 84τ⁵ + 70τ⁶ - 20τ⁷. In Bernstein form: r + 1 zeros, then r + 1 ones.
"""

from collections.abc import Sequence

import numpy as np

from timelaw.easing.profile import Profile
from timelaw.easing.time_scaling import fit_to_limits
from timelaw.easing.timing import Timing
from timelaw.limits import Demand
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import evaluate, split

BISECTIONS = 60  # halvings of [0, 1]: the last bit of a double


def control_points(continuity: int) -> Array:
    """Control points (2r+2,) of the smoothstep with r = `continuity` zero derivatives."""
    return np.repeat([0.0, 1.0], continuity + 1)


def time_leg(demand: Demand, continuity: int) -> Timing:
    """The smoothstep over one leg, from stop to stop, in its least time.

    The quintic's derivatives peak at 15/8, 10/√3 and 60, so that under norm limits
    T = max(1.875 θ/w, √(5.7735 θ/a), ∛(60 θ/j)).
    """
    return fit_to_limits([demand], [Timing(1.0, Profile.single(control_points(continuity), continuity))])[0]


def time_run(demands: Sequence[Demand], continuity: int) -> tuple[Timing, ...]:
    """One smoothstep over a whole run, in its least time, cut at the nodes it passes.

    The slope is cut, whose control points are all positive, so that a leg which is a tiny part of
    the run keeps its digits.
    """
    slope = np.diff(control_points(continuity))
    left = float(sum(demand.angle for demand in demands))
    duration = 1.0
    timings: list[Timing] = []
    for demand in demands[:-1]:
        share = _solve_monotone(_integrated(slope), demand.angle / left)
        piece, slope = split(slope, share)
        timings.append(Timing(duration * share, Profile.single(_integrated(piece), continuity)))
        duration *= 1 - share
        left -= demand.angle
    return fit_to_limits(
        demands, [*timings, Timing(duration, Profile.single(_integrated(slope), continuity))]
    )


def _integrated(slope: Array) -> Array:
    """Control points from exactly 0 to exactly 1 of the integral of a slope, scaled."""
    control = np.concatenate([[0.0], np.cumsum(slope)]) / np.sum(slope)
    control[-1] = 1.0
    return control


def _solve_monotone(control: Array, value: float) -> float:
    """The u with p(u) = value, for an increasing polynomial on [0, 1]."""
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if float(evaluate(control, middle)) < value else (low, middle)
    return (low + high) / 2
