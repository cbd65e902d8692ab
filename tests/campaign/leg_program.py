"""One leg in a given time as a linear program: by how much must the limits give?

The easing's coefficients are unknown, in Chebyshev polynomials or B-splines; every bound on a rate of the
angle is linear in them. Bounds are demanded at many points; what is exceeded between these is the width of
the answer.
"""

from collections.abc import Sequence
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
    return chain_factor((leg,), (time,), space)


def chain_factor(legs: Sequence[Leg], times: Sequence[float], space: Space) -> tuple[float, float]:
    """The same for legs passed at speed, each in its own time; the first begins and the last ends with its rates."""
    coarse, fine = (
        [_scaled(leg, time, _tables(space, n)) for leg, time in zip(legs, times, strict=True)]
        for n in _fineness(space)
    )
    rows = np.vstack([_placed(block, k, len(legs)) for k, (block, _) in enumerate(coarse)])
    firm = np.concatenate([part for _, part in coarse])
    ends = _ends(legs, times, space)
    place = space.values(space.points(_fineness(space)[0]), 0)
    staying = np.vstack([_placed(place, k, len(legs)) for k in range(len(legs))]) if legs[0].stay else None
    lower, upper = 0.0, np.inf
    for _ in range(ROUNDS):
        factor, coefficients = _solve(rows, firm, *ends, staying)
        if coefficients is None:
            return max(lower, np.inf if factor else lower), upper
        parts = np.split(coefficients, len(legs))
        used = [np.abs(block @ part) for (block, _), part in zip(fine, parts, strict=True)]
        over = [hard & (u > 1 + FIRM) for (_, hard), u in zip(fine, used, strict=True)]
        lower = factor
        if not any(np.any(o) for o in over):
            upper = min(
                upper,
                max(
                    factor,
                    *(float(np.max(u[~hard], initial=0.0)) for (_, hard), u in zip(fine, used, strict=True)),
                ),
            )
        if upper <= lower * (1 + TIGHT):
            break
        for k, ((block, hard), u, o) in enumerate(zip(fine, used, over, strict=True)):
            more = o | (~hard & (u > factor * (1 + TIGHT / 2)))
            rows, firm = np.vstack([rows, _placed(block[more], k, len(legs))]), np.r_[firm, hard[more]]
    return lower, upper


def _placed(block: np.ndarray, leg: int, count: int) -> np.ndarray:
    """Rows on the coefficients of one leg of many."""
    wide = np.zeros((len(block), count * block.shape[1]))
    wide[:, leg * block.shape[1] : (leg + 1) * block.shape[1]] = block
    return wide


def _fineness(space: Space) -> tuple[int, int]:
    return (12, 150) if space.breaks else (12 * space.degree + 1, 600 * space.degree + 1)


def _scaled(leg: Leg, time: float, tables: dict[int, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the bounds' used parts, and which of them are firm."""
    blocks = [tables[k] * (leg.angle / time**k / b) for k, b in leg.bounds]
    firm = np.concatenate(
        [np.full(len(block), k in leg.firm) for (k, _), block in zip(leg.bounds, blocks, strict=True)]
    )
    return np.vstack(blocks), firm


def _ends(legs: Sequence[Leg], times: Sequence[float], space: Space) -> tuple[np.ndarray, np.ndarray]:
    """Rows and values of f at the ends of each leg, and of the rates at both ends of all and where legs meet."""
    rows, right, count = [], [], len(legs)
    sides = {
        place: [space.values(np.array([place]), k) for k in range(len(legs[0].start) + 1)]
        for place in (0.0, 1.0)
    }
    for k in range(count):
        rows += [_placed(sides[place][0], k, count) for place in (0.0, 1.0)]
        right += [0.0, 1.0]
    for order in range(1, len(legs[0].start) + 1):
        rate = [leg.angle / time**order for leg, time in zip(legs, times, strict=True)]
        size = [float(np.max(np.abs(sides[place][order]))) for place in (0.0, 1.0)]
        rows += [
            _placed(sides[0.0][order] / size[0], 0, count),
            _placed(sides[1.0][order] / size[1], count - 1, count),
        ]
        right += [legs[0].start[order - 1] / rate[0] / size[0], legs[-1].end[order - 1] / rate[-1] / size[1]]
        for k in range(count - 1):
            whole = size[1] * rate[k] + size[0] * rate[k + 1]
            left, after = (
                _placed(sides[1.0][order] * rate[k], k, count),
                _placed(sides[0.0][order] * rate[k + 1], k + 1, count),
            )
            rows.append((left - after) / whole)
            right.append(0.0)
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
