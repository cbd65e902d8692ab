"""Least times in closed form and by bisection, and motions that are surely possible."""

from math import comb, factorial, inf, sqrt

import numpy as np

from tests.campaign.bounds import demanded

HALVINGS = 200
GRID = (1 - np.cos(np.linspace(0, np.pi, 401))) / 2


def ramp(v: float, a: float, j: float) -> float:
    """Least time [s] from rest to the speed v, levelled off at both ends."""
    if j == inf:
        return v / a
    return v / a + a / j if v * j >= a * a else 2 * sqrt(v / j)


def bisect(rises, low: float, high: float) -> float:
    """Where a predicate turns from true to false, between positive numbers."""
    for _ in range(HALVINGS):
        middle = sqrt(low * high) if high > 4 * low else (low + high) / 2
        if not low < middle < high:
            break
        low, high = (middle, high) if rises(middle) else (low, middle)
    return low


def double_s(angle: float, w: float, a: float, j: float) -> float:
    """Least time over `angle` from rest to rest: the greatest top speed v with v · ramp(v) ≤ angle."""
    if a == inf and j == inf:
        return angle / w if w < inf else 0.0
    tallest = min(w, 1e150)
    if tallest * ramp(tallest, a, j) > angle:
        tallest = bisect(lambda v: v * ramp(v, a, j) <= angle, 1e-150, tallest)
    return angle / tallest + ramp(tallest, a, j)


def phase_times(angle: float, w: float, a: float, j: float) -> list[float]:
    """Durations of the seven phases."""
    total = double_s(angle, w, a, j)
    if a == inf and j == inf:
        return [0.0, 0.0, 0.0, total, 0.0, 0.0, 0.0]
    v = min(w, 1e150)
    if v * ramp(v, a, j) > angle:
        v = bisect(lambda u: u * ramp(u, a, j) <= angle, 1e-150, v)
    rise = ramp(v, a, j)
    jerking = 0.0 if j == inf else min(a / j, sqrt(v / j))
    holding, cruise = max(rise - 2 * jerking, 0.0), max(total - 2 * rise, 0.0)
    return [jerking, holding, jerking, cruise, jerking, holding, jerking]


def angle_after(t: float, angle: float, w: float, a: float, j: float) -> float:
    """Angle of that motion at t, in its first half."""
    if a == inf and j == inf:
        return w * t
    x = v = c = 0.0
    jerks = (j, 0.0, -j, 0.0) if j < inf else (0.0,) * 4
    for phase, (duration, jerk) in enumerate(zip(phase_times(angle, w, a, j)[:4], jerks, strict=True)):
        if j == inf:
            c = a if phase < 3 else 0.0
        u = min(t, duration)
        x, v, c = x + u * (v + u * (c / 2 + u * jerk / 6)), v + u * (c + u * jerk / 2), c + u * jerk
        t -= u
    return x


def factor_for(time: float, least) -> float:
    """The least p by which all limits must grow for `least(p)` to come down to `time`."""
    return bisect(lambda p: least(p) > time, 1e-12, 1e12)


def smoothstep(r: int) -> np.ndarray:
    """Powers of the polynomial of degree 2r + 1 with r rates zero at both ends."""
    powers = np.zeros(2 * r + 2)
    for k in range(r + 1):
        powers[r + 1 + k] = comb(r + k, k) * comb(2 * r + 1, r - k) * (-1) ** k
    return powers


def smoothstep_time(angle: float, r: int, sets: list[dict], body, axis) -> float:
    """Least time [s], a little above, in which the smoothstep holds all limits on a leg."""
    shape = np.polynomial.Polynomial(smoothstep(r))
    rates = {k: shape.deriv(k)(GRID) * angle for k in (1, 2, 3, 4)}

    def broken(time: float) -> bool:
        return demanded(sets, body, axis, {k: rate / time**k for k, rate in rates.items()}) > 1

    return bisect(broken, 1e-9, 1e12) * 1.0005


def least_effort(order: int, r: int, turns: list[float], total: float) -> float | None:
    """Least ∫|k-th rate|² over rest-to-rest turns in a total time, for k = r + 1; None for other r."""
    if r != order - 1:
        return None
    whole = factorial(2 * order - 1) * factorial(2 * order - 2) / factorial(order - 1) ** 2
    share = 2 / (2 * order)  # from T_i ∝ θ_i^(2/2k)
    return whole * sum(t**share for t in turns) ** (2 * order) / total ** (2 * order - 1)
