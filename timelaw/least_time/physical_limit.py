"""The least time that physics allows on a run: what every law is measured by."""

from collections.abc import Sequence
from math import inf

import numpy as np

from timelaw.least_time import double_s, phase_plane
from timelaw.least_time.constant_bounds import rate_bounds
from timelaw.least_time.snap import snap_times
from timelaw.limits import Demand


def run_limit(demands: Sequence[Demand], *, moving: bool = False) -> float:
    """A time [s] that no motion over the run's angle beats, whatever its form.

    The double-S profile in closed form under the plain rates, a bound that counts the snap where that is
    limited, and the phase plane under torque;
    where legs of the run differ in their limits, the loosest of each counts for all, and the time at each
    leg's own velocity limit, or the duration it is given, if that is longer. A run that is
    entered or left `moving` has the velocity limit alone for a bound.
    """
    at_speed = sum(
        demand.angle / rate_bounds(demand.rows)[0] if demand.duration is None else demand.duration
        for demand in demands
    )
    if moving:
        return at_speed
    if all(demand.duration is not None for demand in demands):
        return at_speed
    angle = sum(demand.angle for demand in demands)
    loosest = [max(bounds) for bounds in zip(*(rate_bounds(d.rows) for d in demands), strict=True)]
    least = _least_time(angle, loosest) if min(loosest) < inf else 0.0
    least = max(least, at_speed)
    alike = len({demand.rows_key() for demand in demands}) == 1
    if alike and phase_plane.has_coupling(demands[0].rows):
        return max(least, phase_plane.phase_plane_time(angle, demands[0].rows))
    return least


def _least_time(angle: float, bounds: Sequence[float]) -> float:
    """The double-S, or where the snap is limited too, the bound that counts it."""
    w, a, j, s = bounds
    if s == inf:
        return double_s.double_s_time(angle, w, a, j)
    one = np.array([angle, w, a, j, s])[:, None]
    return float(snap_times(one[0], (one[1], one[2], one[3], one[4]))[0])
