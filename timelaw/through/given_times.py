"""What is made least where time may not be stretched: an effort, a peak, or time beside times that are given.

The merit is the objective relative to the start's, and a price for each leg that breaks a limit. Times that
are given are sums of durations that every step keeps.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from timelaw.numerics.array import Array
from timelaw.through.columns import Columns
from timelaw.through.cone_step import Aim, Step
from timelaw.through.curve import Curve
from timelaw.through.effort import list_residuals, measure_effort
from timelaw.through.measures import LimitMeasure, Measure, Scaled, find_tops, find_use, sample_used
from timelaw.through.rows import Rows
from timelaw.through.search import Look

PRICE = 3.0  # of breaking the limits on all legs, in the objective of the start
NEARLY = 1.01  # of the search's bounds: what is farther beyond them breaks the limits too
LEAST_ROOM = 1e-9  # of a given time, for legs that are left no time by those of fixed duration
FINE = 121  # samples, at which limits must hold
SAMPLES_OF_PEAK = 61
MOST_OVER = 2.0  # a step may break limits by so much more than they are broken already


@dataclass(frozen=True)
class Goal:
    """time/T₀ times its weight, + effort/E₀ times its; or the largest used part of a limit.

    `budgets` are numbers of legs, from the first on, and the time [s] that they take together.
    """

    time: float
    effort: float
    scales: tuple[float, float]
    vector: LimitMeasure
    budgets: tuple[tuple[int, float], ...] = ()
    peak: bool = False


@dataclass(frozen=True)
class GivenTimes:
    """The goal under `limits`, of which the search sees tighter `measures`; `columns` are the search's."""

    goal: Goal
    limits: Sequence[Measure]
    measures: Sequence[Measure]
    columns: Columns
    price: float = PRICE

    def _prices(self, curve: Curve) -> Array:
        """Of each leg (K,)."""
        return self.price * curve.duration / np.sum(curve.duration)

    def look(self, curve: Curve, samples: int) -> Look:
        """At a curve."""
        use = find_use(curve, self.measures, samples, plain=True)
        over = np.maximum(np.maximum(use.stretch, use.fixed) - 1, 0.0)
        if self.goal.peak:
            fixed = self.price * float(np.sum(np.maximum(use.fixed - 1, 0.0)))
            return Look(use, self._peak(curve, samples) + fixed)
        return Look(use, self._objective(curve) + float(self._prices(curve) @ over))

    def _value(self, curve: Curve) -> float:
        """What is made less, prices apart."""
        return self._peak(curve, SAMPLES_OF_PEAK) if self.goal.peak else self._objective(curve)

    def _objective(self, curve: Curve) -> float:
        goal = self.goal
        value = goal.time * curve.total / goal.scales[0]
        if goal.effort:
            value += goal.effort * measure_effort(curve, goal.vector) / goal.scales[1]
        return value

    def _peak(self, curve: Curve, samples: int) -> float:
        """The largest part of a limit that is used, as a quotient."""
        own = [measure for measure in self.measures if measure.power]
        _, used = find_tops(sample_used(curve, own, samples, plain=True))
        powers = np.array([measure.power for measure in own])
        return float(np.max(used**powers))

    def hold(self, curve: Curve) -> Sequence[Measure]:
        """All limits; to make a peak least, the part of them that is used now."""
        if not self.goal.peak:
            return self.measures
        part = self._peak(curve, SAMPLES_OF_PEAK)
        return [Scaled(measure, part) if measure.power else measure for measure in self.measures]

    def sample(self, curve: Curve, measures: Sequence[Measure], samples: int) -> Array:
        """By how much each is used."""
        return sample_used(curve, measures, samples, plain=True)

    def aim(self, curve: Curve, columns: Columns, rows: Rows) -> Aim:
        """The goal, broken limits at their price."""
        goal, cost = self.goal, np.zeros(columns.count)
        kept = self._list_kept(curve, columns)
        legs = columns.legs >= 0
        if goal.peak:
            return Aim(cost, kept=kept, soft=rows.power > 0, price=1.0, shared=True)
        cost[columns.legs[legs]] = goal.time * curve.pieces / goal.scales[0]
        soft = np.ones(len(rows.power), dtype=bool)
        if not goal.effort:
            return Aim(cost, kept=kept, soft=soft, price=self._prices(curve))
        residuals, slopes = list_residuals(curve, columns, goal.vector)
        factor = (2 * goal.effort / goal.scales[1]) ** 0.5
        return Aim(cost, residuals * factor, slopes * factor, kept, soft, self._prices(curve))

    def _list_kept(self, curve: Curve, columns: Columns) -> sparse.csr_matrix:
        rows = np.zeros((len(self.goal.budgets), columns.count))
        for row, (legs, _) in zip(rows, self.goal.budgets, strict=True):
            own = columns.legs[:legs]
            row[own[own >= 0]] = 1.0
        rows = rows[np.any(rows, axis=1)]
        return sparse.csr_matrix(rows / np.mean(curve.duration))

    def predict(self, curve: Curve, tried: Curve, step: Step, columns: Columns) -> float:
        """The goal to second order of its squares, no limit broken."""
        goal = self.goal
        if goal.peak:
            return self._peak(curve, SAMPLES_OF_PEAK) * (1 + float(step.slacks[0]))
        value = goal.time * tried.total / goal.scales[0]
        if goal.effort:
            residuals, slopes = list_residuals(curve, columns, goal.vector)
            after = residuals + slopes @ step.change
            value += goal.effort * float(after @ after) / goal.scales[1]
        return value

    def allows(self, look: Look, before: Look) -> bool:
        """What the next step can mend."""
        return self.goal.peak or look.use.worst < max(MOST_OVER, before.use.worst)

    def keep(self, best: Curve | None, curve: Curve, look: Look) -> Curve | None:
        """The better of two that hold the limits."""
        if look.use.worst > NEARLY or find_use(curve, self.limits, FINE, plain=True).broken:
            return best
        return curve if best is None or self._value(curve) < self._value(best) else best

    def rescue(self, curve: Curve, look: Look) -> Curve | None:  # noqa: ARG002
        """Nothing slower is allowed."""
        return None

    def finish(self, best: Curve) -> Curve:
        """With the times that are given to the last digit."""
        fixed = {int(k): float(best.duration[k]) for k in np.nonzero(self.columns.legs < 0)[0]}
        budgets = [(legs, time / best.pieces) for legs, time in self.goal.budgets]
        return replace(best, duration=fit_durations(best.duration, fixed, budgets))


def fit_durations(
    durations: Array, fixed: Mapping[int, float], budgets: Sequence[tuple[int, float]]
) -> Array:
    """Durations (K,) with those that are `fixed`, the others between two given times by one factor."""
    found = durations.copy()
    for leg, time in fixed.items():
        found[leg] = time
    free = np.array([k not in fixed for k in range(len(found))])
    passed, first = 0.0, 0
    for legs, time in budgets:
        own = np.arange(len(found)) >= first
        own[legs:] = False
        rest = float(np.sum(found[own & ~free]))
        if np.any(own & free):
            room = max(time - passed - rest, LEAST_ROOM * time)
            found[own & free] *= room / float(np.sum(found[own & free]))
        passed, first = time, legs
    return found
