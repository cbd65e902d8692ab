"""The variables of a program, all of order one, and the way to them from timings and back.

Durations T_k in units of those of the start; run after run the rates φ', φ'', …, φ^(r) at its straight nodes,
in units of the run's mean angle over its mean duration^i, shared by the legs on both sides, so that
continuity holds by construction, and the free coefficients of each leg; for the objective `peak` the
used part of the limits.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from typing import NamedTuple

import numpy as np

from timelaw.easing import Timing
from timelaw.easing.family import Basis
from timelaw.limits import Demand
from timelaw.nlp.program import Program, RunProblem
from timelaw.numerics.array import Array


class LegEnd(NamedTuple):
    """Rates at an end of a leg: where they begin among the variables, or what they are, empty for rest."""

    first: int | None
    given: tuple[float, ...]


class LegVariables(NamedTuple):
    """One leg among the variables: its duration at `place`, in a `unit` [s], coefficients from `free` on.

    The i-th derivative of the easing at an end is rate (pace t)^i times the rate there in the run's units.
    """

    place: int
    demand: Demand
    basis: Basis
    continuity: int
    free: int
    left: LegEnd
    right: LegEnd
    unit: float
    pace: float
    rate: float

    def end_derivatives(self, end: LegEnd, x: Array) -> Array:
        """F', …, f^(r) at an end, of the variables x."""
        orders = np.arange(1, self.continuity + 1)
        rates = (
            np.array(end.given or np.zeros(self.continuity))
            if end.first is None
            else (x[end.first : end.first + self.continuity])
        )
        return np.array(self.rate * (self.pace * x[self.place]) ** orders * rates)


@dataclass(frozen=True)
class Variables:
    """How a program's variables follow each other; `units` (legs,) are the durations of the start [s]."""

    program: Program
    units: Array

    @cached_property
    def legs(self) -> list[LegVariables]:
        """Each leg, run after run."""
        found: list[LegVariables] = []
        first = len(self.units)
        for run in self.program.runs:
            own = self.units[len(found) : len(found) + len(run.demands)]
            found += _list_legs(run, own, len(found), first)
            first += _count(run)
        return found

    @cached_property
    def size(self) -> int:
        """How many."""
        peak = int(self.program.objective.scales_limits)
        return len(self.units) + sum(_count(run) for run in self.program.runs) + peak

    def timings(self, x: Array) -> tuple[Timing, ...]:
        """Timings of the legs from the variables (n,) of a solution."""
        return tuple(
            Timing(
                float(x[leg.place] * leg.unit),
                leg.basis.easing(
                    np.concatenate([[0.0], leg.end_derivatives(leg.left, x)]),
                    x[leg.free : leg.free + leg.basis.free],
                    np.concatenate([[1.0], leg.end_derivatives(leg.right, x)]),
                ),
            )
            for leg in self.legs
        )

    def pack(self, timings: Sequence[Timing], peak: float) -> Array:
        """Variables (n,) of given timings, as near as the bases come to their easings."""
        x = np.empty(self.size)
        for leg, timing in zip(self.legs, timings, strict=True):
            x[leg.place] = timing.duration / leg.unit
            x[leg.free : leg.free + leg.basis.free] = leg.basis.free_of(timing.easing)
            if leg.right.first is not None:
                for i in range(1, leg.continuity + 1):
                    power = leg.rate * (leg.pace * x[leg.place]) ** i
                    x[leg.right.first + i - 1] = timing.easing.end(i) / power
        if self.program.objective.scales_limits:
            x[-1] = peak
        return x

    def stretched(self, x: Array, factors: Array) -> Array:
        """Variables of the same easings in `factors` (legs,) times the time, one factor for each run."""
        longer = x.copy()
        for leg, factor in zip(self.legs, factors.tolist(), strict=True):
            longer[leg.place] *= factor
            if leg.right.first is not None:
                longer[leg.right.first : leg.right.first + leg.continuity] /= factor ** np.arange(
                    1.0, leg.continuity + 1
                )
        return longer


def _count(run: RunProblem) -> int:
    """Variables of a run besides durations."""
    return run.family.continuity * (len(run.demands) - 1) + sum(basis.free for basis in run.bases)


def _list_legs(run: RunProblem, units: Array, index: int, first: int) -> Iterator[LegVariables]:
    """The legs of a run whose variables begin at `first`, joined at its straight nodes by shared rates."""
    count, r = len(run.demands), run.family.continuity
    scale, unit = float(np.mean([demand.angle for demand in run.demands])), float(np.mean(units))
    free = accumulate((basis.free for basis in run.bases), initial=first + r * (count - 1))
    ends = [
        LegEnd(None, _scale_end(run.start, r, unit, scale)),
        *(LegEnd(first + r * k, ()) for k in range(count - 1)),
        LegEnd(None, _scale_end(run.end, r, unit, scale)),
    ]
    parts = zip(run.demands, run.bases, free, ends[:-1], ends[1:], units.tolist(), strict=False)
    for k, (demand, basis, place, left, right, own) in enumerate(parts):
        yield LegVariables(
            index + k, demand, basis, r, place, left, right, own, own / unit, scale / demand.angle
        )


def _scale_end(rates: Sequence[float], continuity: int, unit: float, scale: float) -> tuple[float, ...]:
    """Rates outside a run in the units of its node variables; empty at rest."""
    given = [*rates, *[0.0] * continuity][:continuity]
    return tuple(rate * unit**i / scale for i, rate in enumerate(given, 1)) if any(given) else ()
