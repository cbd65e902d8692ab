"""The highest derivative of a spline from its coefficients, exactly.

Coefficients of f near 1 are rounded to 1e-16, and so is what is reckoned with them: differences over short
intervals amplify it, and integrated again the error of one interval spreads over the rest of the leg. In
fractions nothing is rounded but the result, which is then the derivative of one and the same spline.
"""

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from timelaw.numerics.array import Array


def differentiate_spline(
    breaks: Sequence[float], degree: int, left: Array, inner: Array, right: Array
) -> Array:
    """Coefficients (n + p - r - 1,) of the (r+1)-th derivative of a spline of degree p > r.

    It has the `breaks` (n+1,), and at the ends the derivatives `left` and `right` (r+1,); `inner` are the
    n + p - 2(r+1) coefficients between those that these determine.
    c^(k)_i = (p - k + 1) (c^(k-1)_(i+1) - c^(k-1)_i)/(t_(i+p+1) - t_(i+k)).
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
    rates = [*first, *map(Fraction, inner.tolist()), *last[::-1]]
    for level in range(1, len(left) + 1):
        rates = [(rates[i + 1] - rates[i]) / step(level, i) for i in range(len(rates) - 1)]
    return np.array([float(rate) for rate in rates])
