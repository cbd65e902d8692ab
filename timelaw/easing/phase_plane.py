"""What torque allows at a given speed, and the least time under it: the phase plane of one leg.

With rate φ' = v, each torque row leaves an interval for φ''. Least time without a jerk limit goes
up along the largest φ''(v), cruises at the speed limit, and down along the largest -φ''(v):
t = ∫ dv/a(v), φ = ∫ v dv/a(v) (Bobrow, Dubowsky & Gibson 1985, along one axis).
"""

from collections.abc import Callable, Sequence
from math import inf, sqrt

from timelaw.limits import RateRow, Row, TorqueNormRow, TorqueRow

TOLERANCE = 1e-9  # relative, of the quadratures and of the top speed
FAST = 1e6  # top speeds above this multiple of the angle per second are not looked for


def speed_limit(rows: Sequence[Row]) -> float:
    """The largest v at which the body can keep its speed; inf where nothing bounds it."""
    limits = [inf]
    for row in rows:
        if isinstance(row, RateRow) and row.order == 1:
            limits.append(row.effective())
        elif isinstance(row, TorqueRow) and row.gyroscopic:
            limits.append(sqrt(row.bound / abs(row.gyroscopic)))
        elif isinstance(row, TorqueNormRow) and row.gyroscopic:
            limits.append((row.bound / row.gyroscopic**2) ** 0.25)
    return min(limits)


def acceleration_limits(rows: Sequence[Row], v: float) -> tuple[float, float]:
    """The largest φ'' and the largest -φ'' that the rows allow at speed v; inf for no bound."""
    up, down = [inf], [inf]
    for row in rows:
        if isinstance(row, RateRow) and row.order == 2:
            up.append(row.effective())
            down.append(row.effective())
        elif isinstance(row, TorqueRow) and row.linear:
            drift = row.gyroscopic * v * v * (1 if row.linear > 0 else -1)
            up.append(max(row.bound - drift, 0.0) / abs(row.linear))
            down.append(max(row.bound + drift, 0.0) / abs(row.linear))
        elif isinstance(row, TorqueNormRow):
            left = max(row.bound - (row.gyroscopic * v * v) ** 2, 0.0)
            up.append(sqrt(left) / row.linear)
            down.append(sqrt(left) / row.linear)
    return min(up), min(down)


def has_torque(rows: Sequence[Row]) -> bool:
    """Whether any row couples φ'' with φ'²."""
    return any(isinstance(row, TorqueRow | TorqueNormRow) for row in rows)


def least_time(angle: float, rows: Sequence[Row]) -> float:
    """Least time [s] from rest to rest under velocity, acceleration and torque, by quadrature."""
    from scipy.integrate import quad
    from scipy.optimize import brentq

    def integrals(top: float) -> tuple[float, float]:
        """(angle, time) of going up to `top` and down again, v = top (1 - u²) to soften a slow end."""

        def inverse(v: float) -> float:
            return sum(1 / limit if limit > 0 else inf for limit in acceleration_limits(rows, v))

        def along(weight: Callable[[float], float]) -> float:
            def integrand(u: float) -> float:
                v = top * (1 - u * u)
                return 2 * top * u * weight(v) * inverse(v)

            return float(quad(integrand, 0.0, 1.0, epsrel=TOLERANCE, epsabs=0.0, limit=200)[0])

        return along(lambda v: v), along(lambda _: 1.0)

    fastest = min(speed_limit(rows), FAST * angle) * (1 - TOLERANCE)
    reached, time = integrals(fastest)
    if reached <= angle:
        return time + (angle - reached) / fastest
    top = brentq(lambda v: integrals(v)[0] - angle, fastest * 1e-9, fastest, rtol=1e-12)
    return integrals(top)[1]
