"""How far a body turns at least before it is slow enough: what a run that is entered at speed needs."""

from math import inf, sqrt


def braking_distance(start: float, end: float, a: float, j: float) -> float:
    """An angle [rad] within which no motion gets from one speed [rad/s] to another; inf for no bound.

    Under an acceleration limit (v₀² - v₁²)/2a. Under a jerk limit, entered without acceleration, v is at
    least v₀ - j t²/2, so that to rest it takes ⅔ v₀ √(2 v₀/j). Whichever of both ends is the faster counts.
    """
    fast, slow = max(start, end), min(start, end)
    needed = (fast * fast - slow * slow) / (2 * a) if a < inf else 0.0
    if j < inf and slow == 0:
        needed = max(needed, 2 * fast * sqrt(2 * fast / j) / 3)
    return needed
