"""The double-S profile as easings: cut at the nodes of a run, within its limits, in control points."""

from collections.abc import Sequence
from itertools import pairwise
from math import inf

import numpy as np

from timelaw.easing.double_s import NEGLIGIBLE, Phase, least_time, profile, ramp_times
from timelaw.easing.easing import Easing, Timing
from timelaw.easing.phase_plane import acceleration_limits, has_coupling, speed_limit
from timelaw.easing.stretch import fit_to_limits
from timelaw.limits import Row
from timelaw.limits.demand import Demand
from timelaw.numerics.bernstein import hermite_matrix

BISECTIONS = 80  # a monotone cubic is solved to the last bit
WRITTEN_TOLERANCE = 1e-7  # relative time that rounding of control points may cost unnoticed
SHORTEST_PHASE = 2e-5  # of the run: the jerk of shorter phases drowns in the rounding of control points
JERK_FACTORS = (1.0, 1 - 1e-6, 1 - 1e-5, 1 - 1e-4, 0.999, 0.99, 0.9, 0.5, 0.2, 0.1, 0.03, 0.01)
SPEED_SHARES = [k / 64 for k in range(1, 65)]  # of the speed that torque allows: a percent or two apart


def rate_bounds(rows: Sequence[Row]) -> tuple[float, float, float]:
    """Bounds on φ', φ'' and φ''' from the rows of plain rates, inf for one that is not there."""
    w, a, j = (min((row.rate_bound(k) for row in rows), default=inf) for k in (1, 2, 3))
    return w, a, j


def constant_bounds(demands: Sequence[Demand]) -> tuple[float, float, float]:
    """Bounds (w, a, j) that hold on all legs of a run and imply every row, the best for its angle.

    Torque ties φ'' to φ'²; of all speeds v not to be exceeded, each with the φ'' that torque leaves
    up to it, the pair that makes the profile shortest is taken.
    """
    rows = [row for demand in demands for row in demand.rows]
    w, a, j = rate_bounds(rows)
    if not has_coupling(rows):
        return w, a, j
    angle = sum(demand.angle for demand in demands)
    fastest = speed_limit(rows)
    if fastest == inf:  # no gyroscopic part: torque is a plain bound on φ''
        return w, min(acceleration_limits(rows, 0.0)), j
    pairs = [(min(w, s * fastest), min(acceleration_limits(rows, s * fastest)), j) for s in SPEED_SHARES]
    return min((p for p in pairs if p[1] > 0), key=lambda p: least_time(angle, *p))


def fitted_run_timings(demands: Sequence[Demand]) -> tuple[Timing, ...]:
    """The profile over a run as it can be written in control points, within the limits for certain.

    Control points near 1 resolve 1e-16, so a phase of width h of the leg has its jerk rounded by
    some 1e-15/h³: where a jerk phase, or what a node cuts off from one, is very short, the exact
    stretch costs time. Then a slightly slower profile that moves the phases is faster as written.
    No jerk phase is shorter than 2e-5 of the run, which costs as much of the time.
    """
    angles = [demand.angle for demand in demands]
    w, a, j = constant_bounds(demands)
    ideal = least_time(float(sum(angles)), w, a, j)
    best: tuple[Timing, ...] = ()
    least = inf
    t_j, t_a, t_v = ramp_times(float(sum(angles)), w, a, j)
    slowed = min(1.0, t_j / (SHORTEST_PHASE * (2 * t_a + t_v))) if j < inf else 1.0
    for factor in [slowed * factor for factor in JERK_FACTORS] if j < inf else [1.0]:
        timings = fit_to_limits(demands, run_timings(angles, w, a, j * factor))
        total = sum(timing.duration for timing in timings)
        if total < least:
            best, least = timings, total
        if least <= ideal * (1 + WRITTEN_TOLERANCE):
            break
    return best


def run_timings(angles: Sequence[float], w: float, a: float, j: float) -> tuple[Timing, ...]:
    """The profile over a whole run, cut at the nodes it passes: one timing per leg."""
    total = float(sum(angles))
    phases = profile(total, w, a, j)
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
