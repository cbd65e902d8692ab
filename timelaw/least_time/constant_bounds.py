"""Constant bounds on the first three rates of the angle: what the double-S profile is made from."""

from collections.abc import Sequence
from math import inf

from timelaw.least_time.double_s import double_s_time
from timelaw.least_time.phase_plane import acceleration_limits, has_coupling, speed_limit
from timelaw.limits import Demand, Row

SPEED_SHARES = [k / 64 for k in range(1, 65)]  # of the speed that torque allows: a percent or two apart


def rate_bounds(rows: Sequence[Row]) -> tuple[float, float, float, float]:
    """Bounds on the first four rates of the angle from the rows of plain rates, inf for none."""
    w, a, j, s = (min((row.rate_bound(k) for row in rows), default=inf) for k in (1, 2, 3, 4))
    return w, a, j, s


def choose_bounds(demands: Sequence[Demand]) -> tuple[float, float, float]:
    """Bounds (w, a, j) that hold on all legs of a run and imply every row, the best for its angle.

    Torque ties φ'' to φ'²; of all speeds v not to be exceeded, each with the φ'' that torque leaves
    up to it, the pair that makes the profile shortest is taken.
    """
    rows = [row for demand in demands for row in demand.rows]
    w, a, j, _ = rate_bounds(rows)
    if not has_coupling(rows):
        return w, a, j
    angle = sum(demand.angle for demand in demands)
    fastest = speed_limit(rows)
    if fastest == inf:  # no gyroscopic part: torque is a plain bound on φ''
        return w, min(acceleration_limits(rows, 0.0)), j
    pairs = [(min(w, s * fastest), min(acceleration_limits(rows, s * fastest)), j) for s in SPEED_SHARES]
    return min((p for p in pairs if p[1] > 0), key=lambda p: double_s_time(angle, *p))
