"""The derivatives of a spline from its coefficients, exactly.

Coefficients of f near 1 are rounded to 1e-16, and so is what is reckoned with them: differences over short
intervals amplify it, and integrated again what one interval is off by spreads over the rest of the leg. In
fractions nothing is rounded but the result, which is one and the same spline in every piece.
"""

from collections.abc import Sequence
from fractions import Fraction
from math import comb, factorial

import numpy as np

from timelaw.numerics.array import Array


def expand_spline(
    breaks: Sequence[float], degree: int, left: Array, inner: Array, right: Array
) -> tuple[Array, Array]:
    """States (n, r+1) at the starts of the intervals, control points (n, p-r) of the (r+1)-th derivative.

    Of a spline of degree p > r on `breaks` (n+1,) with the derivatives `left` and `right` (r+1,) at its ends;
    `inner` are the n + p - 2(r+1) coefficients between those that these determine.
    """
    levels = _differentiate(breaks, degree, left, inner, right)
    points = [Fraction(b) for b in breaks]
    order, rest = len(left), degree - len(left)
    taylor = [rates[0] / factorial(k) for k, rates in enumerate(levels)]  # of f in powers of the time
    states, controls = [], []
    for i, constant in enumerate(levels[degree]):
        taylor[degree] = constant / factorial(degree)
        h = points[i + 1] - points[i]
        states.append([float(taylor[k] * factorial(k)) for k in range(order)])
        powers = [taylor[order + k] * factorial(order + k) * h**k / factorial(k) for k in range(rest + 1)]
        controls.append(
            [
                float(sum(Fraction(comb(j, k), comb(rest, k)) * powers[k] for k in range(j + 1)))
                for j in range(rest + 1)
            ]
        )
        for lowest in range(degree):  # Horner's shift to the next break
            for k in range(degree - 1, lowest - 1, -1):
                taylor[k] += h * taylor[k + 1]
    return np.array(states), np.array(controls)


def _differentiate(
    breaks: Sequence[float], degree: int, left: Array, inner: Array, right: Array
) -> list[list[Fraction]]:
    """Coefficients of the spline and of all its derivatives, the p-th being constants on the intervals.

    c^(k)_i = (p - k + 1) (c^(k-1)_(i+1) - c^(k-1)_i)/(t_(i+p+1) - t_(i+k)); the first and the last are the
    derivatives at the ends, from which the first and last r + 1 of the spline itself follow backwards.
    """
    points = [Fraction(b) for b in breaks]
    knots = [points[0]] * degree + points + [points[-1]] * degree
    count = len(inner) + 2 * len(left)

    def step(level: int, i: int) -> Fraction:
        """From the i-th coefficient of the derivative below to the next, for each unit of this one."""
        return (knots[i + degree + 1] - knots[i + level]) / (degree - level + 1)

    first, last = [Fraction(left[-1])], [Fraction(right[-1])]
    for level in range(len(left) - 1, 0, -1):
        forward, backward = [Fraction(left[level - 1])], [Fraction(right[level - 1])]
        for i, rate in enumerate(first):
            forward.append(forward[-1] + rate * step(level, i))
        for i, rate in enumerate(last):
            backward.append(backward[-1] - rate * step(level, count - level - 1 - i))
        first, last = forward, backward
    levels = [[*first, *map(Fraction, inner.tolist()), *last[::-1]]]
    for level in range(1, degree + 1):
        below = levels[-1]
        levels.append([(below[i + 1] - below[i]) / step(level, i) for i in range(len(below) - 1)])
    return levels
