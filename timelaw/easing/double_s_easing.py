"""The double-S profile cut at the nodes of a run: constant jerk on up to seven durations."""

from bisect import bisect_right
from collections.abc import Sequence
from math import inf

import numpy as np

from timelaw.easing.profile import Piece, Profile
from timelaw.easing.time_scaling import fit_to_limits
from timelaw.easing.timing import Timing
from timelaw.least_time.constant_bounds import choose_bounds
from timelaw.least_time.double_s import Phase, double_s_time, list_phases, ramp_times
from timelaw.limits import Demand

POWERS = (0.999, 3.001)  # of a ratio of times, and some room for rounding
BISECTIONS = 80  # a monotone cubic is solved to the last bit


def fit_double_s(demands: Sequence[Demand]) -> tuple[Timing, ...]:
    """The profile over a run, within its limits for certain, cut at the nodes: one timing per leg."""
    angles = [demand.angle for demand in demands]
    return fit_to_limits(demands, cut_double_s(angles, *choose_bounds(demands)))


def classify_profile(demands: Sequence[Demand]) -> int:
    """The class C^k of the double-S profile: 2 where jerk is limited, 1 where acceleration is, else 0."""
    _, a, j = choose_bounds(demands)
    return 2 if j < inf else 1 if a < inf else 0


def spread_double_s(demand: Demand, duration: float) -> Timing:
    """The profile over a leg in a given time that uses the least part p of the limits on its plain rates.

    T(θ; p w, p a, p j) = duration: p = c^x, c the least time over the duration, x from 1 where the velocity
    counts alone to 3 where the jerk does.
    """
    from scipy.optimize import brentq

    w, a, j = choose_bounds((demand,))
    ratio = double_s_time(demand.angle, w, a, j) / duration

    def late(power: float) -> float:
        p = ratio**power
        return float(double_s_time(demand.angle, p * w, p * a, p * j) / duration - 1)

    p = ratio ** brentq(late, *POWERS) if late(POWERS[0]) * late(POWERS[1]) < 0 else 1.0
    (timing,) = cut_double_s((demand.angle,), p * w, p * a, p * j)
    return timing.stretched(duration / timing.duration)


def cut_double_s(
    angles: Sequence[float], w: float, a: float, j: float, shortest: float = 0.0
) -> tuple[Timing, ...]:
    """The profile over a whole run, cut at the nodes it passes: one timing per leg.

    With `shortest` the jerk is lowered, if need be, until no jerk phase is shorter than this part of the run.
    """
    total = float(sum(angles))
    t_j, t_a, t_v = ramp_times(total, w, a, j)
    if j < inf and t_j < shortest * (2 * t_a + t_v):
        j *= t_j / (shortest * (2 * t_a + t_v))
    phases = list_phases(total, w, a, j)
    starts = [phase.angle for phase in phases]
    depth = 3 if j < inf else 2 if a < inf else 1
    ends: list[tuple[int, float]] = []  # phase and time in it at which each node is passed
    reached = 0.0
    for angle in angles[:-1]:
        reached += angle
        index = max(bisect_right(starts, reached) - 1, 0)
        ends.append((index, _time_at(phases[index], reached)))
    ends.append((len(phases) - 1, phases[-1].duration))
    timings, since = [], (0, 0.0)
    for angle, until in zip(angles, ends, strict=True):
        timings.append(_timing(phases, since, until, angle, depth))
        since = until
    return tuple(timings)


def _time_at(phase: Phase, angle: float) -> float:
    """Time in the phase at which `angle` is reached; its end where that comes later by rounding only."""
    low, high = 0.0, phase.duration
    if phase.at(high)[0] <= angle:
        return high
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if phase.at(middle)[0] < angle else (low, middle)
    return high


def _timing(
    phases: Sequence[Phase], since: tuple[int, float], until: tuple[int, float], angle: float, depth: int
) -> Timing:
    """One leg's part of the phases, as an easing: `depth` is the order of the rate that is constant."""
    pieces: list[Piece] = []
    travelled = 0.0
    for index in range(since[0], until[0] + 1):
        phase = phases[index]
        start = since[1] if index == since[0] else 0.0
        end = until[1] if index == until[0] else phase.duration
        if end <= start:
            continue
        rates = phase.at(start)
        piece = Piece(end - start, np.array([travelled, *rates[1:depth]]), np.array([rates[depth]]))
        travelled = Profile((piece,)).end(0)
        pieces.append(piece)
    profile = Profile(tuple(pieces))
    return Timing(profile.duration, profile.scaled(1 / angle, 1 / profile.duration))
