"""What laws are compared by: each criterion a number of a certified law, and which way is better."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, isfinite

import numpy as np

from timelaw.certificate.effort import measure_effort, measure_torque
from timelaw.pipeline import Certified

TIED = 1e-9  # relative; values nearer than that are one


@dataclass(frozen=True)
class Criterion:
    """A key, what it is, its unit, and how a law does by it: less is better, unless said otherwise.

    `applies` says whether a law has such a number at all.
    """

    key: str
    words: str
    unit: str
    measure: Callable[[Certified], float]
    more_is_better: bool = False
    applies: Callable[[Certified], bool] = lambda _: True


def _peak(order: int) -> Callable[[Certified], float]:
    return lambda entry: float(np.degrees(entry.certificate.continuity.peaks[order]))


def _effort(order: int) -> Callable[[Certified], float]:
    return lambda entry: measure_effort(entry.law, entry.certificate.continuity, order)


def _measure_torque(entry: Certified) -> float:
    return measure_torque(entry.law) if entry.certificate.continuity.order >= 1 else inf


def _has_torque(entry: Certified) -> bool:
    body = entry.law.body
    return body is not None and not body.total_momentum


CRITERIA = (
    Criterion("time", "total time", "s", lambda entry: entry.law.duration),
    Criterion("motion", "time in motion", "s", lambda e: sum(leg.duration for leg in e.law.legs)),
    Criterion("velocity", "largest |ω|", "deg/s", _peak(1)),
    Criterion("acceleration", "largest |α|", "deg/s²", _peak(2)),
    Criterion("jerk", "largest |jerk|", "deg/s³", _peak(3)),
    Criterion("energy", "∫|α|² dt", "rad²/s³", _effort(2)),
    Criterion("smoothness", "∫|jerk|² dt", "rad²/s⁵", _effort(3)),
    Criterion("torque", "∫|τ|² dt", "N²·m²·s", _measure_torque, applies=_has_torque),
    Criterion("class", "class C^k", "", lambda entry: entry.certificate.order, more_is_better=True),
)


@dataclass(frozen=True)
class Line:
    """One criterion over all laws: their values, and their ranks from 1, equal ones alike."""

    criterion: Criterion
    values: tuple[float, ...]
    ranks: tuple[int, ...]

    def difference(self, index: int) -> float | None:
        """How much more than the first law's, as a part of it; None where that says nothing."""
        first, value = self.values[0], self.values[index]
        if not first or not isfinite(first) or not isfinite(value) or self.criterion.more_is_better:
            return None
        return value / first - 1


def list_lines(laws: Sequence[Certified]) -> list[Line]:
    """The criteria that all laws have a number for."""
    found = []
    for criterion in CRITERIA:
        if all(criterion.applies(entry) for entry in laws):
            values = tuple(criterion.measure(entry) for entry in laws)
            found.append(Line(criterion, values, rank(values, criterion.more_is_better)))
    return found


def rank(values: Sequence[float], more_is_better: bool = False) -> tuple[int, ...]:
    """1 for the best, as many before it plus one for each; what is within rounding is alike."""
    sense = -1.0 if more_is_better else 1.0
    return tuple(1 + sum(_is_less(sense * other, sense * value) for other in values) for value in values)


def _is_less(one: float, other: float) -> bool:
    if one == other:
        return False
    return one < other - TIED * abs(other) if isfinite(other) else one < other


def order_names(line: Line, names: Sequence[str]) -> str:
    """The names with their ranks, from the best to the worst, equal ones joined."""
    groups = {k: [n for n, r in zip(names, line.ranks, strict=True) if r == k] for k in sorted({*line.ranks})}
    return ", ".join(f"{k}. {' = '.join(group)}" for k, group in groups.items())


def show_part(part: float | None) -> str:
    """A difference in percent; empty where there is none to be said."""
    return "" if part is None else f"{round(100 * part, 2) + 0.0:+.2f} %"
