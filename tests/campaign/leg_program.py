"""One leg in a given time as a linear program: by how much must the limits give?

The easing's coefficients are unknown, in Chebyshev polynomials or B-splines; every bound on a rate of the
angle is linear in them. Bounds are demanded at many points; what is exceeded between these is the width of
the answer.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev
from scipy.interpolate import BSpline
from scipy.optimize import linprog

ROUNDS = 4
INFEASIBLE = 2  # linprog's status
FIRM = 1e-8  # relative
PASSES = 0.01  # of the leg
TIGHT = 2e-6  # relative: what may be exceeded between the points


@dataclass(frozen=True)
class Space:
    """Polynomials of a degree, or where `breaks` are given splines on them."""

    degree: int
    breaks: tuple[float, ...] = ()

    def values(self, tau: np.ndarray, order: int) -> np.ndarray:
        """Rows at τ, one column for each coefficient, of the k-th derivative."""
        if self.breaks:
            knots = np.r_[[0.0] * self.degree, self.breaks, [1.0] * self.degree]
            count = len(knots) - self.degree - 1
            if order > self.degree:
                return np.zeros((len(tau), count))
            spline = BSpline(knots, np.eye(count), self.degree)
            return np.asarray(spline.derivative(order)(tau) if order else spline(tau))
        columns = []
        for k in range(self.degree + 1):
            unit = np.eye(self.degree + 1)[k]
            derived = chebyshev.chebder(unit, order) if order else unit
            columns.append(chebyshev.chebval(2 * tau - 1, derived) * 2.0**order)
        return np.array(columns).T

    def points(self, fine: int) -> np.ndarray:
        """Crowded towards the ends, of the whole or of each interval."""
        local = (1 - np.cos(np.linspace(0, np.pi, fine))) / 2
        if not self.breaks:
            return local
        return np.unique(
            np.concatenate([a + (b - a) * local for a, b in zip(self.breaks, self.breaks[1:], strict=False)])
        )


@lru_cache(maxsize=64)
def _tables(space: Space, fine: int) -> dict[int, np.ndarray]:
    tau = space.points(fine)
    return {k: space.values(tau, k) for k in (1, 2, 3, 4)}


@dataclass(frozen=True)
class Leg:
    """Angle [rad], bounds by order of rate, rates at both ends (r each).

    Orders that are `firm` keep their bounds as they are: where a rate at an end is at its bound, no law has
    room there. One that must `stay` on the arc passes neither end by more than a hundredth of it.
    """

    angle: float
    bounds: tuple[tuple[int, float], ...]
    start: tuple[float, ...]
    end: tuple[float, ...]
    firm: frozenset[int] = frozenset()
    stay: bool = False


def least_factor(leg: Leg, time: float, space: Space) -> tuple[float, float]:
    """(lower, upper) of the least p such that p times the bounds, but for firm ones, can be held in `time`."""
    (rows, firm), (dense, dense_firm) = (
        _scaled(leg, time, _tables(space, fine)) for fine in _fineness(space)
    )
    ends = _ends(leg, time, space)
    place = space.values(space.points(_fineness(space)[0]), 0) if leg.stay else None
    lower, upper = 0.0, np.inf
    for _ in range(ROUNDS):
        factor, coefficients = _solve(rows, firm, *ends, place)
        if coefficients is None:
            return max(lower, np.inf if factor else lower), upper
        used = np.abs(dense @ coefficients)
        over = dense_firm & (used > 1 + FIRM)
        lower = factor
        if not np.any(over):
            upper = min(upper, max(factor, float(np.max(used[~dense_firm], initial=0.0))))
        if upper <= lower * (1 + TIGHT):
            break
        more = over | (~dense_firm & (used > factor * (1 + TIGHT / 2)))
        rows, firm = np.vstack([rows, dense[more]]), np.r_[firm, dense_firm[more]]
    return lower, upper


def _fineness(space: Space) -> tuple[int, int]:
    return (12, 150) if space.breaks else (12 * space.degree + 1, 600 * space.degree + 1)


def _scaled(leg: Leg, time: float, tables: dict[int, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the bounds' used parts, and which of them are firm."""
    blocks = [tables[k] * (leg.angle / time**k / b) for k, b in leg.bounds]
    firm = np.concatenate(
        [np.full(len(block), k in leg.firm) for (k, _), block in zip(leg.bounds, blocks, strict=True)]
    )
    return np.vstack(blocks), firm


def _ends(leg: Leg, time: float, space: Space) -> tuple[np.ndarray, np.ndarray]:
    """Rows and values of f and its rates at both ends, each row of size one."""
    rows, right = [space.values(np.array([0.0, 1.0]), 0)], [0.0, 1.0]
    for place, rates in ((0.0, leg.start), (1.0, leg.end)):
        for k, rate in enumerate(rates, 1):
            row = space.values(np.array([place]), k)
            size = float(np.max(np.abs(row)))
            rows.append(row / size)
            right.append(rate * time**k / leg.angle / size)
    return np.vstack(rows), np.array(right)


def _solve(rows, firm, ends, right, place):
    """Least p with |rows c| ≤ p, or 1 where they are firm, and c; none, and 1 for sure, if nothing is feasible."""
    shares = np.where(firm, 0.0, -1.0)[:, None]
    upper, most = (
        np.vstack([np.hstack([rows, shares]), np.hstack([-rows, shares])]),
        np.tile(np.where(firm, 1.0, 0.0), 2),
    )
    if place is not None:
        none = np.zeros((len(place), 1))
        upper = np.vstack([upper, np.hstack([place, none]), np.hstack([-place, none])])
        most = np.r_[most, np.full(len(place), 1 + PASSES), np.full(len(place), PASSES)]
    found = linprog(
        np.r_[np.zeros(rows.shape[1]), 1.0],
        A_ub=upper,
        b_ub=most,
        A_eq=np.hstack([ends, np.zeros((len(ends), 1))]),
        b_eq=right,
        bounds=[(None, None)] * rows.shape[1] + [(0, None)],
        method="highs",
    )
    return (found.x[-1], found.x[:-1]) if found.status == 0 else (float(found.status == INFEASIBLE), None)


def least_factor_over_times(leg: Leg, space: Space, guess: float) -> tuple[float, float, float]:
    """(time, lower, upper) with the least p of all times: a scan over three decades, then closer."""
    times = guess * np.logspace(-1.3, 1.7, 31)
    best = min(range(len(times)), key=lambda i: least_factor(leg, float(times[i]), space)[0])
    low, high = times[max(best - 1, 0)], times[min(best + 1, len(times) - 1)]
    golden = (5**0.5 - 1) / 2
    for _ in range(20):
        one, other = high - golden * (high - low), low + golden * (high - low)
        if least_factor(leg, one, space)[0] <= least_factor(leg, other, space)[0]:
            high = other
        else:
            low = one
    return (low + high) / 2, *least_factor(leg, (low + high) / 2, space)


def least_time(
    leg: Leg, space: Space, low: float, high: float, tolerance: float = 1e-6
) -> tuple[float, float]:
    """(lower, upper) of the least time from rest to rest: the factor falls with time."""
    for _ in range(60):
        if high - low <= tolerance * high:
            break
        middle = (low + high) / 2
        factor = least_factor(leg, middle, space)
        if factor[0] > 1:
            low = middle
        else:
            high = middle
    excess = least_factor(leg, high, space)
    return low, high * max(1.0, excess[1])
