"""Limits proved for all t: extrema of the law's polynomials, enclosed, against the bounds."""

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from timelaw.limits import Row
from timelaw.limits.polynomials import row_polynomials
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.extrema import peaks
from timelaw.numerics.polynomial import Polynomial


@dataclass(frozen=True)
class LimitCheck:
    """One limit over the whole motion, or over the one leg that has it, in SI.

    `peak` is a value the law takes, at `time` [s] in `segment`; `upper` a bound it never exceeds,
    rounding included. The limit holds if `upper` ≤ `bound`; no tolerance. `order` is the highest
    rate that enters it.
    """

    limit: str
    bound: float
    peak: float
    upper: float
    time: float
    segment: str
    unit: str
    order: int

    @property
    def holds(self) -> bool:
        """Whether the limit is proved for all t."""
        return self.upper <= self.bound

    @property
    def ratio(self) -> float:
        """Peak over limit."""
        return self.upper / self.bound

    @property
    def margin(self) -> float:
        """1 - peak/limit; negative where the limit is broken."""
        return 1 - self.ratio


@dataclass(frozen=True)
class _Place:
    row: Row
    segment: Segment
    piece: int
    polynomial: Polynomial


def check_limits(law: QuaternionLaw) -> tuple[LimitCheck, ...]:
    """Every limit that the law carries, axis by axis where it is given so, general ones first."""
    groups: dict[str, list[_Place]] = defaultdict(list)
    for segment in law.segments:
        for row, own in law.rows(segment):
            label = f"{row.label} on {own}" if own else row.label
            groups[label] += [
                _Place(row, segment, piece, polynomial)
                for row, piece, polynomial in row_polynomials([row], segment.rates)
            ]
    names = sorted(groups, key=lambda label: " on " in label)
    return tuple(_check(name, groups[name]) for name in names)


def _check(label: str, places: list[_Place]) -> LimitCheck:
    """Enclose the largest value of one limit's rows; squares are given back as what they are squares of."""
    tops = peaks([place.polynomial.control for place in places])
    root = 1 / places[0].row.root
    uppers = [(top.upper + p.polynomial.error) ** root for top, p in zip(tops, places, strict=True)]
    highest = max(range(len(tops)), key=lambda i: tops[i].lower)
    place, top = places[highest], tops[highest]
    start, end = place.segment.breaks[place.piece : place.piece + 2]
    tau = float(start + top.at * (end - start))
    return LimitCheck(
        label,
        place.row.bound**root,
        top.lower**root,
        float(np.max(uppers)) * ROUNDING,  # NumPy's maximum of what is not a number is not a number
        place.segment.start_time + place.segment.duration * tau,
        place.segment.name,
        place.row.unit,
        max(place.row.orders),
    )


ROUNDING = 1 + 2e-15  # of the last few operations, the root among them
