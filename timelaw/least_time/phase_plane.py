"""What torque allows at a given speed, and the least time under it: the phase plane of one leg.

With rate φ' = v, each torque row leaves an interval for φ''. Least time without a jerk limit goes
up along the largest φ''(v), cruises at the speed limit, and down along the largest -φ''(v):
t = ∫ dv/a(v), φ = ∫ v dv/a(v) (Bobrow, Dubowsky & Gibson 1985, along one axis).
"""

from collections.abc import Callable, Sequence
from math import inf

from timelaw.limits import Row

TOLERANCE = 1e-9  # relative, of the quadratures and of the top speed
FAST = 1e6  # top speeds above this multiple of the angle per second are not looked for


def speed_limit(rows: Sequence[Row]) -> float:
    """The largest v at which the body can keep its speed; inf where nothing bounds it."""
    return min((row.speed_limit() for row in rows), default=inf)


def acceleration_limits(rows: Sequence[Row], v: float) -> tuple[float, float]:
    """The largest φ'' and the largest -φ'' that the rows allow at speed v; inf for no bound."""
    limits = [row.acceleration_limits(v) for row in rows]
    return min((up for up, _ in limits), default=inf), min((down for _, down in limits), default=inf)


def has_coupling(rows: Sequence[Row]) -> bool:
    """Whether any row ties φ'' to φ'."""
    return any(row.couples for row in rows)


def phase_plane_time(angle: float, legs: Sequence[Sequence[Row]]) -> float:
    """Least time [s] from rest to rest over legs under velocity, acceleration and torque, by quadrature.

    Where the legs differ in their rows, the loosest of them counts at each speed: a bound.
    """
    from scipy.integrate import quad
    from scipy.optimize import brentq

    def integrals(top: float) -> tuple[float, float]:
        """(angle, time) of going up to `top` and down again, v = top (1 - u²) to soften a slow end."""

        def inverse(v: float) -> float:
            loosest = map(max, zip(*(acceleration_limits(rows, v) for rows in legs), strict=True))
            return sum(1 / limit if limit > 0 else inf for limit in loosest)

        def along(weight: Callable[[float], float]) -> float:
            def integrand(u: float) -> float:
                v = top * (1 - u * u)
                return 2 * top * u * weight(v) * inverse(v)

            return float(quad(integrand, 0.0, 1.0, epsrel=TOLERANCE, epsabs=0.0, limit=200)[0])

        return along(lambda v: v), along(lambda _: 1.0)

    fastest = min(max(speed_limit(rows) for rows in legs), FAST * angle) * (1 - TOLERANCE)
    reached, time = integrals(fastest)
    if reached <= angle:
        return time + (angle - reached) / fastest
    top = brentq(lambda v: integrals(v)[0] - angle, fastest * 1e-9, fastest, rtol=1e-12)
    return integrals(top)[1]
