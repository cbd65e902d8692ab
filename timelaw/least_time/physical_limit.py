"""The least time that physics allows on a run: what every law is measured by."""

from collections.abc import Sequence
from math import inf, sqrt

import numpy as np

from timelaw.least_time import double_s, phase_plane
from timelaw.least_time.constant_bounds import rate_bounds
from timelaw.least_time.snap import snap_times
from timelaw.limits import Demand


def run_limit(demands: Sequence[Demand], ends: tuple[float, float] | None = None) -> float:
    """A time [s] that no motion over the run's angle beats, whatever its form; zero where none is known.

    From rest to rest: the double-S profile in closed form under the plain rates, a bound that counts the
    snap where that is limited, and the phase plane under torque. `ends` are the speeds φ' [rad/s] at which
    the run is entered and left moving, inf where the first is not known; a ramp of constant acceleration
    before and after makes a motion from rest to rest: T + v₀/a + v₁/a ≥ T_wa(θ + v₀²/2a + v₁²/2a). Where
    legs of the run differ in their limits, the loosest of each counts for all, and the time at each leg's
    own velocity limit, or the duration it is given, if that is longer.
    """
    at_speed = sum(
        demand.angle / rate_bounds(demand.rows)[0] if demand.duration is None else demand.duration
        for demand in demands
    )
    if all(demand.duration is not None for demand in demands):
        return at_speed
    angle = sum(demand.angle for demand in demands)
    loosest = [max(bounds) for bounds in zip(*(rate_bounds(d.rows) for d in demands), strict=True)]
    if ends is not None:
        return max(at_speed, _moving_time(angle, loosest, ends))
    least = _least_time(angle, loosest) if min(loosest) < inf else 0.0
    legs = list({demand.rows_key(): demand.rows for demand in demands}.values())
    if any(phase_plane.has_coupling(rows) for rows in legs):
        least = max(least, phase_plane.phase_plane_time(angle, legs))
    return max(least, at_speed)


def _moving_time(angle: float, bounds: Sequence[float], ends: tuple[float, float]) -> float:
    """Under velocity and acceleration alone, which the ramps keep; an unknown speed is the best there is."""
    w, a = bounds[:2]
    if a == inf:
        return 0.0
    start, end = ends
    whole = angle + end * end / (2 * a)
    start = min(w, sqrt(2 * a * whole)) if start == inf else start
    return double_s.double_s_time(whole + start * start / (2 * a), w, a, inf) - (start + end) / a


def _least_time(angle: float, bounds: Sequence[float]) -> float:
    """The double-S, or where the snap is limited too, the bound that counts it."""
    w, a, j, s = bounds
    if s == inf:
        return double_s.double_s_time(angle, w, a, j)
    one = np.array([angle, w, a, j, s])[:, None]
    return float(snap_times(one[0], (one[1], one[2], one[3], one[4]))[0])
