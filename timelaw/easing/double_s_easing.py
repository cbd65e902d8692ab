"""The double-S profile as easings: cut at the nodes of a run, within its limits, in control points."""

from collections.abc import Sequence
from itertools import pairwise
from math import inf

import numpy as np

from timelaw.easing.easing import Easing
from timelaw.easing.time_scaling import fit_to_limits
from timelaw.easing.timing import Timing
from timelaw.least_time.constant_bounds import choose_bounds
from timelaw.least_time.double_s import NEGLIGIBLE, Phase, double_s_time, list_phases, ramp_times
from timelaw.limits import Demand
from timelaw.numerics.bernstein import hermite_matrix

BISECTIONS = 80  # a monotone cubic is solved to the last bit
WRITTEN_TOLERANCE = 1e-7  # relative time that rounding of control points may cost unnoticed
SHORTEST_PHASE = 2e-5  # of the run: the jerk of shorter phases drowns in the rounding of control points
JERK_FACTORS = (1.0, 1 - 1e-6, 1 - 1e-5, 1 - 1e-4, 0.999, 0.99, 0.9, 0.5, 0.2, 0.1, 0.03, 0.01)


def fit_double_s(demands: Sequence[Demand]) -> tuple[Timing, ...]:
    """The profile over a run as it can be written in control points, within the limits for certain.

    Control points near 1 resolve 1e-16, so a phase of width h of the leg has its jerk rounded by
    some 1e-15/h³: where a jerk phase, or what a node cuts off from one, is very short, the exact
    stretch costs time. Then a slightly slower profile that moves the phases is faster as written.
    No jerk phase is shorter than 2e-5 of the run, which costs as much of the time.
    """
    angles = [demand.angle for demand in demands]
    w, a, j = choose_bounds(demands)
    ideal = double_s_time(float(sum(angles)), w, a, j)
    best: tuple[Timing, ...] = ()
    least = inf
    t_j, t_a, t_v = ramp_times(float(sum(angles)), w, a, j)
    slowed = min(1.0, t_j / (SHORTEST_PHASE * (2 * t_a + t_v))) if j < inf else 1.0
    for factor in [slowed * factor for factor in JERK_FACTORS] if j < inf else [1.0]:
        timings = fit_to_limits(demands, cut_double_s(angles, w, a, j * factor))
        total = sum(timing.duration for timing in timings)
        if total < least:
            best, least = timings, total
        if least <= ideal * (1 + WRITTEN_TOLERANCE):
            break
    return best


def cut_double_s(angles: Sequence[float], w: float, a: float, j: float) -> tuple[Timing, ...]:
    """The profile over a whole run, cut at the nodes it passes: one timing per leg."""
    total = float(sum(angles))
    phases = list_phases(total, w, a, j)
    timings: list[Timing] = []
    start = 0.0
    for angle in angles[:-1]:
        inside, phases = _cut(phases, start + angle)
        timings.append(_timing(inside, start, angle))
        start += angle
    return (*timings, _timing(phases, start, angles[-1]))


def _cut(phases: list[Phase], angle: float) -> tuple[list[Phase], list[Phase]]:
    """The phases before and after the instant at which `angle` is reached."""
    index = max(i for i, p in enumerate(phases) if p.angle < angle)
    phase, low, high = phases[index], 0.0, phases[index].duration
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if phase.at(middle)[0] < angle else (low, middle)
    first = Phase(high, phase.angle, phase.velocity, phase.acceleration, phase.jerk)
    left = phase.duration - high
    rest = [Phase(left, *phase.at(high))] if left > NEGLIGIBLE * phase.duration else []
    return [*phases[:index], first], [*rest, *phases[index + 1 :]]


def _timing(phases: list[Phase], start: float, angle: float) -> Timing:
    """One leg's phases as a piecewise cubic easing from exactly 0 to exactly 1."""
    durations = np.array([p.duration for p in phases])
    duration = float(np.sum(durations))
    breaks = np.concatenate([[0.0], np.cumsum(durations) / duration])
    breaks[-1] = 1.0
    hermite = hermite_matrix(3, 4)
    pieces = []
    for p in phases:
        scaled = [p.angle - start, p.velocity * p.duration, p.acceleration * p.duration**2]
        pieces.append(hermite @ np.array([*scaled, p.jerk * p.duration**3]) / angle)
    pieces[0][0], pieces[-1][-1] = 0.0, 1.0
    for before, after in pairwise(pieces):
        before[-1] = after[0]
    return Timing(duration, Easing(breaks, tuple(pieces)))
