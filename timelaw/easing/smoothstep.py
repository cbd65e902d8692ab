"""Smoothsteps: the polynomial of least degree with r derivatives zero at both ends.

r = 2 is the law of [MMB2017], 6τ⁵ - 15τ⁴ + 10τ³, which is also the minimum-jerk law; r = 3 the
septic 35τ⁴ - 84τ⁵ + 70τ⁶ - 20τ⁷. In Bernstein form: r + 1 zeros, then r + 1 ones.
"""

from collections.abc import Sequence

import numpy as np

from timelaw.easing.profile import Piece, Profile
from timelaw.easing.time_scaling import fit_runs, fit_to_limits
from timelaw.easing.timing import Timing
from timelaw.limits import Demand
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import evaluate, split

MIDDLE = 0.5
BISECTIONS = 60  # halvings of [0, 1]: the last bit of a double


def control_points(continuity: int) -> Array:
    """Control points (2r+2,) of the smoothstep with r = `continuity` zero derivatives."""
    return np.repeat([0.0, 1.0], continuity + 1)


def time_leg(demand: Demand, continuity: int) -> Timing:
    """The smoothstep over one leg, from stop to stop, in its least time.

    The quintic's derivatives peak at 15/8, 10/√3 and 60, so that under norm limits
    T = max(1.875 θ/w, √(5.7735 θ/a), ∛(60 θ/j)).
    """
    return time_legs([demand], continuity)[0]


def time_legs(demands: Sequence[Demand], continuity: int) -> list[Timing]:
    """The smoothstep over each of many legs that are independent of each other."""
    plain = Timing(1.0, Profile.single(control_points(continuity), continuity))
    return [timing for (timing,) in fit_runs([[d] for d in demands], [[plain]] * len(demands))]


def time_run(demands: Sequence[Demand], continuity: int) -> tuple[Timing, ...]:
    """One smoothstep over a whole run, in its least time, cut at the nodes it passes.

    Each leg begins with the rates of the whole there, so that a leg which is a tiny part of the run joins as
    exactly as any.
    """
    whole = Profile.single(control_points(continuity), continuity)
    rates = [whole.derivative(order)[0].control for order in range(continuity + 2)]
    cuts = _cut([demand.angle for demand in demands], rates[0])
    total = sum(demand.angle for demand in demands)
    timings = []
    for demand, (start, left), (end, still) in zip(demands, cuts, cuts[1:], strict=False):
        width = end - start if start < MIDDLE else left - still
        highest = split(split(rates[-1], start)[1], width / left)[0]
        state = np.array([0.0, *(float(evaluate(rate, start)) for rate in rates[1:-1])])
        part = Profile((Piece(width, state, highest),))
        timings.append(Timing(width, part.scaled(total / demand.angle, 1 / width)))
    return fit_to_limits(demands, timings)


def _cut(angles: Sequence[float], control: Array) -> list[tuple[float, float]]:
    """(u, 1 - u) of a smoothstep where it has travelled so far, each exact near its end: it is symmetric."""
    total, cuts = sum(angles), [(0.0, 1.0)]
    for count in range(1, len(angles)):
        before, after = sum(angles[:count]), sum(angles[count:])
        near = _solve_monotone(control, min(before, after) / total)
        cuts.append((near, 1 - near) if before <= after else (1 - near, near))
    return [*cuts, (1.0, 0.0)]


def _solve_monotone(control: Array, value: float) -> float:
    """The u with p(u) = value, for an increasing polynomial on [0, 1]."""
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if float(evaluate(control, middle)) < value else (low, middle)
    return (low + high) / 2
