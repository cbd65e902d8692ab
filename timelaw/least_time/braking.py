"""What a run that is entered at speed needs at least: angle to get slow in, room below its limits."""

from collections.abc import Iterator, Sequence
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


def list_reached(
    rates: Sequence[float], bounds: Sequence[float], continuity: int, *, backwards: bool
) -> Iterator[tuple[int, float]]:
    """(k, r_k + r_(k+1) |r_(k+1)| / 2b): how far each rate r_k goes on at least that has r_(k+1) beside it.

    With b the bound on r_(k+2): r_(k+1) is taken back to nothing at that rate at most, which takes
    r_(k+1)/b. Of an end of the motion, `backwards` in time, r_(k+1) has the other sign. Only where r_(k+1)
    does not jump: in class C^(k+1).
    """
    for k in range(1, min(len(rates), continuity, len(bounds) - 1)):
        rate, rising, bound = rates[k - 1], rates[k], bounds[k + 1]
        if bound < inf:
            rising = -rising if backwards else rising
            yield k, rate + rising * abs(rising) / (2 * bound)
