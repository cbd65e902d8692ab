"""The double-S profile: least time from rest to rest under velocity, acceleration and jerk limits.

Up to seven phases of constant jerk (Biagiotti & Melchiorri 2008, ch. 3). Without a jerk limit it is the
trapezoid of velocity, without an acceleration limit too, constant velocity. No motion over the
same angle is faster, whatever its form: this is the physical limit that reports compare with.
Jerk alone gives T = ∛(32 θ/j), acceleration alone 2√(θ/a), velocity alone θ/w.
"""

from dataclasses import dataclass
from math import inf, sqrt

import numpy as np

from timelaw.numerics.array import Array

NEGLIGIBLE = 1e-15  # a phase of no jerk that lasts this part of the whole changes no digit of anything


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


def double_s_time(angle: float, w: float, a: float, j: float) -> float:
    """T [s] of the profile over `angle` [rad]; inf stands for a limit that is not there."""
    _, t_a, t_v = ramp_times(angle, w, a, j)
    return 2 * t_a + t_v


def double_s_times(angle: Array, w: Array, a: Array, j: Array) -> Array:
    """T [s] for many angles and limits at once, arrays of one shape, without a loop; see `ramp_times`."""
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        # to a speed limit, and cruising; without a jerk limit t_a = w/a
        t_j = np.minimum(np.sqrt(w / j), a / j)
        t_a = np.where(j == inf, w / a, t_j + w / (j * t_j))
        cruising = np.where((w < inf) & (w * t_a <= angle), angle / w + t_a, inf)
        # without cruising: as far as jerk alone gets, or up to the acceleration limit
        t_j = np.cbrt(angle / (2 * j))
        t_c = a / j
        held = 2 * (t_c / 2 + np.sqrt(t_c * t_c / 4 + angle / a))
        turning = np.where(j == inf, 2 * np.sqrt(angle / a), np.where(j * t_j <= a, 4 * t_j, held))
    return np.where(cruising < inf, cruising, turning)


def list_phases(angle: float, w: float, a: float, j: float) -> list[Phase]:
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
    # what bends the motion counts however short it is
    return [p for p in phases if p.jerk or p.duration > NEGLIGIBLE * (2 * t_a + t_v)]


def _mirrored(phase: Phase, angle: float) -> Phase:
    """The phase run backwards from the end of the motion: φ(T - t) = θ - φ(t)."""
    reached, velocity, acceleration, jerk = phase.at(phase.duration)
    return Phase(phase.duration, angle - reached, velocity, -acceleration, jerk)
