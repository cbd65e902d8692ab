"""Legs and runs: curves with the easings u = f(τ) that may be chosen on them, from stop to stop."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from timelaw.bezier.curve import Curve
from timelaw.bezier.rates import STATES, Split, list_used, measure_parts
from timelaw.easing import Profile, Timing
from timelaw.easing.family import Basis
from timelaw.easing.polynomial_basis import PolynomialBasis
from timelaw.easing.registry import POLYNOMIAL_DEGREE, spline_degree
from timelaw.easing.smoothstep import control_points
from timelaw.easing.spline_basis import SplineBasis
from timelaw.numerics.array import Array
from timelaw.problem.problem import EasingModel

INTERVALS = 24  # of a spline, if the file does not say: the law has as many pieces on a curve
PER_INTERVAL = 12  # points of a spline's interval at which limits are looked at
POINTS = 240  # of a polynomial


@dataclass(frozen=True)
class Leg:
    """A curve, the basis of its easing, its limits, and H (3,) in the world; `tau` are its points (m,)."""

    curve: Curve
    basis: Basis
    tau: Array
    limits: tuple[Split, ...]
    total: Array

    @cached_property
    def derivatives(self) -> Array:
        """(5, m, ·): what takes control points to f, f', … at the points."""
        return np.stack([self.basis.values(self.tau, k) for k in range(STATES)])


def make_basis(easing: EasingModel, continuity: int) -> tuple[Basis, Array]:
    """The basis that a problem names, and points (m,) close enough for its limits."""
    if not easing.kind.pieces:
        degree = easing.degree or max(POLYNOMIAL_DEGREE, 2 * continuity + 3)
        tau = (1 - np.cos(np.pi * np.arange(POINTS + 1) / POINTS)) / 2
        return PolynomialBasis(degree, continuity), tau
    degree = easing.degree or spline_degree(continuity)
    fewest = max(2, 2 * continuity + 3 - degree)
    count = easing.intervals or max(INTERVALS, fewest)
    breaks = np.linspace(0.0, 1.0, count + 1)
    return SplineBasis(degree, tuple(breaks.tolist()), continuity), np.linspace(
        0, 1, count * PER_INTERVAL + 1
    )


@dataclass(frozen=True)
class Passage:
    """The rates u', u'', … at a joint that is passed, seen from the curve before it; β of the joint."""

    ratios: tuple[float, ...]

    def carry(self, rates: Array) -> Array:
        """The rates (r,) of the parameter of the curve after it."""
        b = [*self.ratios, 0.0, 0.0, 0.0]
        p, a, j = [*rates.tolist(), 0.0, 0.0, 0.0][:3]
        found = [b[0] * p, b[0] * a + b[1] * p**2, b[0] * j + 3 * b[1] * p * a + b[2] * p**3]
        return np.array(found[: len(rates)])

    def slope(self, rates: Array) -> Array:
        """∂(rates after)/∂(rates before) (r, r)."""
        b = [*self.ratios, 0.0, 0.0, 0.0]
        p, a, _ = [*rates.tolist(), 0.0, 0.0, 0.0][:3]
        rows = [
            [b[0], 0.0, 0.0],
            [2 * b[1] * p, b[0], 0.0],
            [3 * b[1] * a + 3 * b[2] * p**2, 3 * b[1] * p, b[0]],
        ]
        return np.array(rows)[: len(rates), : len(rates)]


@dataclass(frozen=True)
class Run:
    """Legs that are passed through without a stop, with the passages between them."""

    legs: tuple[Leg, ...]
    passages: tuple[Passage, ...]

    @property
    def continuity(self) -> int:
        """Derivatives that are continuous at the nodes."""
        return self.legs[0].basis.continuity


@dataclass(frozen=True)
class Choice:
    """What is chosen on a run: durations (K,), free coefficients, and rates (K-1, r) at joints passed."""

    durations: Array
    free: tuple[Array, ...]
    rates: Array

    @property
    def total(self) -> float:
        """The time of the run [s]."""
        return float(np.sum(self.durations))

    def stretched(self, factor: float) -> "Choice":
        """The same in `factor` times the time."""
        powers = factor ** np.arange(1.0, self.rates.shape[1] + 1)
        return Choice(self.durations * factor, self.free, self.rates / powers)

    def ends(self, run: Run, leg: int) -> tuple[Array, Array]:
        """F, f', …, f^(r) (r+1,) at both ends of a leg, in τ."""
        r = run.continuity
        powers = self.durations[leg] ** np.arange(1.0, r + 1)
        before = run.passages[leg - 1].carry(self.rates[leg - 1]) if leg else np.zeros(r)
        after = self.rates[leg] if leg < len(run.passages) else np.zeros(r)
        return np.concatenate([[0.0], before * powers]), np.concatenate([[1.0], after * powers])

    def control(self, run: Run, leg: int) -> Array:
        """Control points of a leg's easing."""
        basis = run.legs[leg].basis
        left, right = self.ends(run, leg)
        return np.asarray(
            basis.from_left @ left + basis.from_free @ self.free[leg] + basis.from_right @ right
        )

    def states(self, run: Run, leg: int) -> Array:
        """u, u', … in time (m, 5) at a leg's points."""
        powers = self.durations[leg] ** np.arange(float(STATES))
        return np.asarray((run.legs[leg].derivatives @ self.control(run, leg)).T / powers)

    def used(self, run: Run, leg: int) -> Array:
        """The part of each limit (l, m) that is used at a leg's points."""
        own = run.legs[leg]
        return list_used(measure_parts(own.curve, own.limits, self.states(run, leg), own.total), own.limits)

    def timings(self, run: Run) -> tuple[Timing, ...]:
        """As easings, each in its time."""
        return tuple(
            Timing(float(t), leg.basis.easing(self.ends(run, k)[0], self.free[k], self.ends(run, k)[1]))
            for k, (t, leg) in enumerate(zip(self.durations, run.legs, strict=True))
        )


def begin(run: Run) -> Choice:
    """A stop at every node, smoothsteps of one second between."""
    slow = Profile.single(control_points(run.continuity), run.continuity)
    free = tuple(leg.basis.free_of(slow) for leg in run.legs)
    return Choice(np.ones(len(run.legs)), free, np.zeros((len(run.passages), run.continuity)))


def split_runs(legs: Sequence[Leg], passages: Sequence[Passage | None]) -> tuple[Run, ...]:
    """Runs between stops; a passage of None is a stop."""
    runs, first = [], 0
    for index, passage in enumerate([*passages, None], 1):
        if passage is None:
            inner = tuple(p for p in passages[first : index - 1] if p is not None)
            runs.append(Run(tuple(legs[first:index]), inner))
            first = index
    return tuple(runs)
