"""The double-S profile: least time from rest to rest under velocity, acceleration and jerk limits.

Up to seven phases of constant jerk (Biagiotti & Melchiorri 2008, ch. 3). Without a jerk limit it is the
trapezoid of velocity, without an acceleration limit too, constant velocity. No motion over the
same angle is faster, whatever its form: this is the physical limit that reports compare with.
Jerk alone gives T = ∛(32 θ/j), acceleration alone 2√(θ/a), velocity alone θ/w.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf, sqrt

import numpy as np

from timelaw.easing.easing import Easing, Timing
from timelaw.easing.stretch import fit_to_limits
from timelaw.limits import Rate
from timelaw.numerics.bernstein import hermite_matrix

BISECTIONS = 80  # a monotone cubic is solved to the last bit
WRITTEN_TOLERANCE = 1e-7  # relative time that rounding of control points may cost unnoticed
JERK_FACTORS = (1.0, 1 - 1e-6, 1 - 1e-5, 1 - 1e-4, 0.999, 0.99, 0.9, 0.5, 0.2, 0.1, 0.03, 0.01, 0.003, 0.001)
NEGLIGIBLE = 1e-12  # a phase shorter than this part of the whole is rounding, not a phase


@dataclass(frozen=True)
class Phase:
    """Constant jerk for `duration` [s], from angle, velocity and acceleration at its start."""

    duration: float
    angle: float
    velocity: float
    acceleration: float
    jerk: float

    def at(self, t: float) -> tuple[float, float, float, float]:
        """Angle and its three derivatives t seconds into the phase."""
        a, j = self.acceleration, self.jerk
        velocity = self.velocity + t * (a + t * j / 2)
        return self.angle + t * (self.velocity + t * (a / 2 + t * j / 6)), velocity, a + t * j, j


def ramp_times(angle: float, w: float, a: float, j: float) -> tuple[float, float, float]:
    """(t_j, t_a, t_v) [s]: constant-jerk time, whole ramp, cruise; inf for no limit. T = 2 t_a + t_v.

    A ramp to velocity v takes t_a = t_j + v/(j t_j), t_j = min(√(v/j), a/j), and both ramps
    together travel v t_a; what is left of the angle is cruised through.
    """
    if w < inf:
        t_j = min(sqrt(w / j), a / j) if j < inf else 0.0
        t_a = t_j + w / (j * t_j) if j < inf else w / a
        if w * t_a <= angle:
            return t_j, t_a, angle / w - t_a
    if j == inf:
        return 0.0, sqrt(angle / a), 0.0
    t_j = (angle / (2 * j)) ** (1 / 3)
    if j * t_j <= a:
        return t_j, 2 * t_j, 0.0
    t_j = a / j
    return t_j, t_j / 2 + sqrt(t_j * t_j / 4 + angle / a), 0.0


def least_time(angle: float, w: float, a: float, j: float) -> float:
    """T [s] of the profile over `angle` [rad]; inf stands for a limit that is not there."""
    _, t_a, t_v = ramp_times(angle, w, a, j)
    return 2 * t_a + t_v


def profile(angle: float, w: float, a: float, j: float) -> list[Phase]:
    """The phases of the profile, those of no duration left out."""
    t_j, t_a, t_v = ramp_times(angle, w, a, j)
    top = angle / (t_a + t_v)  # the area under the velocity
    if t_j > 0:
        steps = [(t_j, 0.0, j), (t_a - 2 * t_j, j * t_j, 0.0), (t_j, j * t_j, -j)]
    else:
        steps = [(t_a, top / t_a, 0.0)] if t_a > 0 else []
    rising: list[Phase] = []
    travelled, velocity = 0.0, 0.0
    for duration, acceleration, jerk in steps:
        rising.append(Phase(duration, travelled, velocity, acceleration, jerk))
        travelled, velocity, _, _ = rising[-1].at(duration)
    phases = [*rising, Phase(t_v, travelled, top, 0.0, 0.0), *(_mirrored(p, angle) for p in rising[::-1])]
    return [p for p in phases if p.duration > NEGLIGIBLE * (2 * t_a + t_v)]


def _mirrored(phase: Phase, angle: float) -> Phase:
    """The phase run backwards from the end of the motion: φ(T - t) = θ - φ(t)."""
    reached, velocity, acceleration, jerk = phase.at(phase.duration)
    return Phase(phase.duration, angle - reached, velocity, -acceleration, jerk)


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


def bounds(limits: Sequence[Rate]) -> tuple[float, float, float]:
    """Velocity, acceleration and jerk limits, inf for one that is not there."""
    w, a, j = (next((limit.bound for limit in limits if limit.order == k), inf) for k in (1, 2, 3))
    return w, a, j


def fitted_run_timings(angles: Sequence[float], limits: Sequence[Rate]) -> tuple[Timing, ...]:
    """The profile over a run as it can be written in control points, within the limits for certain.

    Control points near 1 resolve 1e-16, so a phase of width h of the leg has its jerk rounded by
    some 1e-15/h³: where a jerk phase, or what a node cuts off from one, is very short, the exact
    stretch costs time. Then a slightly slower profile that moves the phases is faster as written.
    """
    w, a, j = bounds(limits)
    ideal = least_time(float(sum(angles)), w, a, j)
    best: tuple[Timing, ...] = ()
    least = inf
    for factor in JERK_FACTORS if j < inf else JERK_FACTORS[:1]:
        timings = fit_to_limits(angles, run_timings(angles, w, a, j * factor), limits)
        total = sum(timing.duration for timing in timings)
        if total < least:
            best, least = timings, total
        if least <= ideal * (1 + WRITTEN_TOLERANCE):
            break
    return best


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
