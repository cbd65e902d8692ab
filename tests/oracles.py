"""Answers from elsewhere: nothing here imports timelaw.

The linear program works in Chebyshev polynomials on [-1, 1], bisects on the duration and finds
extrema as roots; the tool works in Bernstein form, with the duration as a variable and enclosures.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev as cheb
from numpy.polynomial import polynomial as power
from scipy.optimize import linprog

QUINTIC = np.array([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
SEPTIC = np.array([0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0])

# Peaks of f', f'', f''' on [0, 1]: 15/8, 10/√3, 60 for the quintic; for the septic by hand:
# f' = 140 u³ with u = τ(1-τ) ≤ 1/4; f'' = 420 u² (1-2τ), greatest at u = 1/5; f''' = 840 u (1-5u),
# greatest at u = 1/10 (84·½) or at τ = ½ (|840·¼·(-¼)| = 52.5).
QUINTIC_PEAKS = (15 / 8, 10 / 3**0.5, 60.0)
SEPTIC_PEAKS = (35 / 16, 420 / 25 * (1 / 5) ** 0.5, 52.5)


def smoothstep_duration(peaks: Sequence[float], angle: float, limits: Sequence[float]) -> float:
    """T = max over k of (peak_k θ/limit_k)^(1/k)."""
    return max((p * angle / m) ** (1 / k) for k, (p, m) in enumerate(zip(peaks, limits, strict=True), 1))


def extremum(coefficients: np.ndarray) -> float:
    """max |p| on [0, 1] of a polynomial in powers, from the roots of its derivative."""
    roots = power.polyroots(power.polyder(coefficients)) if len(coefficients) > 2 else np.array([])
    inside = [r.real for r in roots if abs(r.imag) < 1e-7 and -1e-12 < r.real < 1 + 1e-12]
    points = np.clip(np.array([0.0, 1.0, *inside]), 0, 1)
    return float(np.max(np.abs(power.polyval(points, coefficients))))


@dataclass
class LinearProgram:
    """Least duration of a run from rest to rest, one polynomial per leg, under norm limits.

    The legs' shares of the total time are given, so for a fixed total everything is linear.
    """

    degree: int
    continuity: int
    angles: tuple[float, ...]
    limits: dict[int, float]
    shares: tuple[float, ...] = (1.0,)

    def basis(self, points: np.ndarray, order: int) -> np.ndarray:
        """Rows at the points, columns T_0 … T_d on [-1, 1], k-th derivative with respect to τ."""
        columns = []
        for k in range(self.degree + 1):
            unit = np.eye(self.degree + 1)[k]
            columns.append(cheb.chebval(points, cheb.chebder(unit, order) if order else unit) * 2.0**order)
        return np.array(columns).T

    def place(self, block: np.ndarray, leg: int) -> np.ndarray:
        wide = np.zeros((len(block), len(self.angles) * (self.degree + 1)))
        wide[:, leg * (self.degree + 1) : (leg + 1) * (self.degree + 1)] = block
        return wide

    def equalities(self) -> tuple[np.ndarray, np.ndarray]:
        """f from 0 to 1 on each leg, rest at both ends of the run, equal rates at its nodes."""
        rows, right, last = [], [], len(self.angles) - 1
        for leg in range(len(self.angles)):
            rows.append(self.place(self.basis(np.array([-1.0, 1.0]), 0), leg))
            right += [0.0, 1.0]
        for k in range(1, self.continuity + 1):
            start, end = self.basis(np.array([-1.0]), k), self.basis(np.array([1.0]), k)
            rows += [self.place(start, 0), self.place(end, last)]
            right += [0.0, 0.0]
            for leg in range(last):
                rate = [a / s**k for a, s in zip(self.angles, self.shares, strict=True)]
                left, after = self.place(end * rate[leg], leg), self.place(start * rate[leg + 1], leg + 1)
                rows.append((left - after) / rate[leg])
                right.append(0.0)
        return np.vstack(rows), np.array(right)

    def solve(self, tolerance: float = 1e-6) -> tuple[float, float]:
        """(lower, upper): no feasible duration below `lower`, one found at `upper`."""
        cosines = np.cos(np.pi * np.arange(4 * self.degree + 1) / (4 * self.degree))
        points = {(leg, k): cosines for leg in range(len(self.angles)) for k in self.limits}
        total = sum(self.angles)
        peaks = (*QUINTIC_PEAKS, 360.0)
        high = max((peaks[k - 1] * total / m) ** (1 / k) for k, m in self.limits.items()) * 2.5
        upper, lower = np.inf, 0.0
        for _ in range(12):
            lower, solution = self._bisect(points, lower, high, tolerance / 8)
            upper = min(upper, lower * self._add_extrema(points, solution, lower))
            if upper <= lower * (1 + tolerance):
                break
        return lower, upper

    def _bisect(self, points, low, high, tolerance):
        best = None
        while best is None or high - low > tolerance * high:
            middle = (low + high) / 2 if best is not None else high
            ratio, solution = self._least_ratio(points, middle)
            if ratio <= 1:
                high, best = middle, solution
            elif best is None:
                high *= 2
            else:
                low = middle
        return high, best

    def _least_ratio(self, points, duration):
        """Least t with |θ f^(k)/T^k| ≤ t limit_k at the points: linear in the coefficients."""
        rows = [
            self.place(self.basis(tau, k), leg) * self._scale(leg, k, duration)
            for (leg, k), tau in points.items()
        ]
        stacked = np.vstack(rows)
        ones = np.ones((len(stacked), 1))
        equal, right = self.equalities()
        result = linprog(
            np.r_[np.zeros(stacked.shape[1]), 1.0],
            A_ub=np.vstack([np.hstack([stacked, -ones]), np.hstack([-stacked, -ones])]),
            b_ub=np.zeros(2 * len(stacked)),
            A_eq=np.hstack([equal, np.zeros((len(equal), 1))]),
            b_eq=right,
            bounds=[(None, None)] * stacked.shape[1] + [(0, None)],
            method="highs",
        )
        assert result.status == 0, result.message
        return result.x[-1], result.x[:-1].reshape(len(self.angles), -1)

    def _scale(self, leg, order, duration):
        return self.angles[leg] / (duration * self.shares[leg]) ** order / self.limits[order]

    def _add_extrema(self, points, solution, duration):
        """Worst stretch of time that the true extrema ask for; they join the points."""
        worst = 1.0
        for leg, k in points:
            rate = cheb.chebder(solution[leg], k) * 2.0**k * self._scale(leg, k, duration)
            roots = cheb.chebroots(cheb.chebder(rate))
            inside = np.array([r.real for r in roots if abs(r.imag) < 1e-6 and abs(r.real) < 1])
            sizes = np.abs(cheb.chebval(np.concatenate([[-1.0, 1.0], inside]), rate))
            worst = max(worst, np.max(sizes) ** (1 / k))
            near = [t + s for t in inside[sizes[2:] > 1 - 1e-9] for s in (-2e-3, -5e-4, 0.0, 5e-4, 2e-3)]
            points[leg, k] = np.unique(np.clip(np.concatenate([points[leg, k], near]), -1, 1))
        return worst
