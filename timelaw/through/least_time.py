"""Least time where time may be stretched: Σ h s is made less, s the factor by which a leg is too fast."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from timelaw.numerics.array import Array
from timelaw.through.columns import Columns
from timelaw.through.cone_step import Aim, Step
from timelaw.through.curve import Curve
from timelaw.through.measures import Measure, find_use, sample_used
from timelaw.through.rows import Rows
from timelaw.through.search import Look

MOST_OVER = 1.3  # a step may break limits by so much, to be mended by the next
FINE = 241  # samples for the last stretch
CLOSE = 1e-7  # of the time, to which a step is solved
PRICE = 2.0  # of breaking what slowness does not mend, in mean durations of a leg


@dataclass(frozen=True)
class LeastTime:
    """Σ h s with s ≥ 1 of each leg by itself, and a price for what slowness does not mend."""

    measures: Sequence[Measure]

    def look(self, curve: Curve, samples: int) -> Look:
        """At a curve."""
        use = find_use(curve, self.measures, samples)
        time = np.sum(curve.duration * np.maximum(use.stretch, 1.0))
        broken = PRICE * np.mean(curve.duration) * np.sum(np.maximum(use.fixed - 1, 0.0))
        return Look(use, float(time + broken) * curve.pieces)

    def hold(self, curve: Curve) -> Sequence[Measure]:  # noqa: ARG002
        """All limits."""
        return self.measures

    def sample(self, curve: Curve, measures: Sequence[Measure], samples: int) -> Array:
        """By how much each is used."""
        return sample_used(curve, measures, samples)

    def aim(self, curve: Curve, columns: Columns, rows: Rows) -> Aim:
        """Σ h, what slowness does not mend at its price."""
        cost = np.zeros(columns.count)
        cost[columns.legs] = 1 / np.mean(curve.duration)
        soft = rows.power == 0
        if np.any(soft):  # at its price a small breach is worth more than time is solved to
            return Aim(cost, soft=soft, price=PRICE)
        return Aim(cost, gap=CLOSE * len(curve.duration))

    def predict(self, curve: Curve, tried: Curve, step: Step, columns: Columns) -> float:  # noqa: ARG002
        """The time."""
        return tried.total

    def allows(self, look: Look, before: Look) -> bool:  # noqa: ARG002
        """What the next step can mend."""
        return look.use.worst < MOST_OVER

    def keep(self, best: Curve | None, curve: Curve, look: Look) -> Curve | None:
        """The faster of two once they hold the limits; what is kept does."""
        use = look.use
        if use.excess or (best is not None and curve.total * use.worst >= best.total):
            return best
        return curve.stretched(use.worst)

    def rescue(self, curve: Curve, look: Look) -> Curve | None:
        """As slow as it must be."""
        return curve.stretched(look.use.worst)

    def finish(self, best: Curve) -> Curve:
        """As fast as it may be."""
        return best.stretched(find_use(best, self.measures, FINE).worst)
