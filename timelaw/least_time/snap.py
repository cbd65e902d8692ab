"""Least time from rest to rest where the snap is limited too: a bound in closed form up to a root.

The double-S ignores the snap. With a fourth bound no closed form of the least time is known (of symmetric
profiles it is [Z2025], but laws that are not point-symmetric ramp by ramp are up to 7 % faster: snap
alone allows T = ∜(384 θ/s), the symmetric profile takes ∜(512 θ/s)). What no law beats is the largest of

- the double-S, under velocity, acceleration and jerk;
- ∜(384 θ/s), the perfect spline, under snap alone;
- what cannot be travelled sooner from either end: from rest a'' obeys the snap, so that a(t) stays below the
  fastest rise to its limit that levels off there, and v(t) below the integral of that, levelled off at its
  own limit by the jerk alone. Until T/2 no more than half of θ can be travelled so.

Where cruise, acceleration and jerk are all reached, the last is below the symmetric profile by a (j/s)²/12w
at most, some 1e-4 of the whole.
"""

from collections.abc import Callable, Sequence
from math import sqrt

import numpy as np

from timelaw.least_time.double_s import double_s_times
from timelaw.numerics.array import Array

PERFECT_SPLINE = 384.0
HALVINGS = 60  # of a bracket: the last bit of a double
DOUBLINGS = 200


def snap_times(angle: Array, bounds: tuple[Array, Array, Array, Array]) -> Array:
    """A time (...) [s] that no motion over `angle` (...) beats under bounds on four rates, inf for none."""
    w, a, j, s = bounds
    plain = double_s_times(angle, w, a, j)
    limited = np.isfinite(s) & (angle > 0)
    if not np.any(limited):
        return plain
    theta, ceilings = angle[limited], tuple(bound[limited] for bound in bounds)
    alone = (PERFECT_SPLINE * theta / ceilings[3]) ** 0.25
    known = np.fmax(plain[limited], alone)
    times = plain.copy()
    level = _solve_level(*ceilings)
    times[limited] = _solve(lambda t: _reach(t / 2, level, *ceilings) - theta / 2, known)
    return times


def symmetric_time(angle: float, bounds: Sequence[float]) -> float:
    """T [s] of the profile that is point-symmetric ramp by ramp, under bounds on successive rates [Z2025].

    T = θ/v̂ + v̂/â + â/ĵ + ĵ/s, each hat the bound or what the ramps above it allow; inf for no bound. With
    three bounds it is the double-S. A motion that is attained, not the fastest there is.
    """
    if len(bounds) == 1:
        return angle / bounds[0]
    if len(bounds) == 2:
        top = min(bounds[0], sqrt(angle * bounds[1]))
        return angle / top + top / bounds[1]

    def excess(top: float) -> float:
        """Positive where the plateau at `top` still lasts longer than the ramp up to it."""
        return angle / top - symmetric_time(top, bounds[1:])

    low = high = min(bounds[0], 1.0)
    while excess(low) < 0:
        low /= 2
    while high < bounds[0] and excess(high) > 0:
        high *= 2
    high = min(high, bounds[0])
    for _ in range(HALVINGS if excess(high) < 0 else 0):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) > 0 else (low, middle)
    return angle / high + symmetric_time(high, bounds[1:])


def _solve(excess: Callable[[Array], Array], known: Array) -> Array:
    """The last T ≥ known where `excess(T)`, which never falls, is not above zero, from below."""
    low, high = known.copy(), 2.0 * known
    for _ in range(DOUBLINGS):
        short = excess(high) < 0
        if not np.any(short):
            break
        low, high = np.where(short, high, low), np.where(short, 2 * high, high)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        short = excess(middle) < 0
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    return low


def _reach(t: Array, level: Array, w: Array, a: Array, j: Array, s: Array) -> Array:
    """An angle (...) beyond which nothing can travel in t (...) from rest, at `level` levelling off."""
    angle, velocity, acceleration = _rise(np.minimum(t, level), a, j, s)
    ease = np.where(np.isfinite(j), acceleration / j, 0.0)
    rest = np.maximum(t - level, 0.0)
    easing, cruising = np.minimum(rest, ease), np.maximum(rest - ease, 0.0)
    curve = np.where(np.isfinite(j), j, 0.0)
    angle += easing * (velocity + easing * (acceleration / 2 - easing * curve / 6))
    return np.asarray(angle + np.where(cruising > 0, np.where(np.isfinite(w), w, 0.0) * cruising, 0.0))


def _solve_level(w: Array, a: Array, j: Array, s: Array) -> Array:
    """When levelling off at w must begin, jerk alone counted: a²/2j + v = w; inf where w is none."""
    capped = np.isfinite(w)
    ceiling = np.where(capped, w, 1.0)

    def excess(t: Array) -> Array:
        _, velocity, acceleration = _rise(t, a, j, s)
        return np.asarray(velocity + np.where(np.isfinite(j), acceleration**2 / (2 * j), 0.0) - ceiling)

    scale = np.cbrt(ceiling / s) / 8
    return np.where(capped, _solve(excess, scale), np.inf)


def _rise(t: Array, a: Array, j: Array, s: Array) -> tuple[Array, Array, Array]:
    """Angle, velocity and acceleration of the fastest rise to the acceleration a, at t."""
    top = np.minimum(j, np.sqrt(a * s))
    turn = top / s
    with np.errstate(invalid="ignore"):
        hold = np.where(np.isfinite(top), np.maximum(a / top - turn, 0.0), np.inf)
    angle, velocity, acceleration, jerk = (np.zeros_like(t) for _ in range(4))
    start = np.zeros_like(t)
    none, ever = np.zeros_like(s), np.full_like(s, np.inf)
    for duration, snap in ((turn, s), (hold, none), (turn, -s), (ever, none)):
        u = np.clip(t - start, 0.0, duration)
        angle = angle + u * (velocity + u * (acceleration / 2 + u * (jerk / 6 + u * snap / 24)))
        velocity = velocity + u * (acceleration + u * (jerk / 2 + u * snap / 6))
        acceleration = acceleration + u * (jerk + u * snap / 2)
        jerk = jerk + u * snap
        start = start + duration
    return angle, velocity, acceleration
