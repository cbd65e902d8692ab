"""What a run that is entered at speed needs at least: angle to get slow in, room below its limits."""

from collections.abc import Iterator, Sequence
from math import inf, sqrt

import numpy as np

from timelaw.numerics.array import Array

DIPS = 4096  # speeds to which a motion may slow on its way; steps between them make the angle a little less


def stopping_distance(speed: float, a: float, j: float) -> float:
    """An angle [rad] within which no motion gets to rest from a speed [rad/s], or the other way.

    Under an acceleration limit (inf for none) v²/2a. Under a jerk limit, entered without acceleration, the
    speed is at least v - j t²/2, so that it takes ⅔ v √(2 v/j).
    """
    needed = speed * speed / (2 * a) if a < inf else 0.0
    return max(needed, 2 * speed * sqrt(2 * speed / j) / 3) if j < inf else needed


def changing_distance(start: float, end: float, a: float, j: float) -> float:
    """An angle [rad] within which no motion that never turns back gets from one speed [rad/s] to another.

    Between a speed v and the least one u on the way, both without acceleration under a jerk limit, it takes
    (v + u) t/2, with t = x/a + a/j or 2 √(x/j) the time of a ramp by x = v - u. The least of all u counts,
    each taken for a little faster or slower as makes it less.
    """
    dips = np.linspace(0.0, min(start, end), DIPS + 1)
    return float(np.min(sum((v + dips[:-1]) * _ramp(v - dips[1:], a, j) / 2 for v in (start, end))))


def _ramp(change: Array, a: float, j: float) -> Array:
    """The least time for a change of speed, levelled off at both ends where the jerk is limited."""
    if j == inf:
        return change / a
    return np.where(change * j < a * a, 2 * np.sqrt(change / j), change / a + (a / j if a < inf else 0.0))


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
