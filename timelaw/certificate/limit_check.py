"""Limits proved for all t: extrema of the law's polynomials, enclosed, against the bounds."""

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from timelaw.motion import QuaternionLaw, Segment
from timelaw.motion.segment import Quantity
from timelaw.numerics.function import enclose_peaks

ROUNDING = 1 + 2e-15  # of the last few operations, the root among them


@dataclass(frozen=True)
class LimitCheck:
    """One limit over the whole motion, or over the one leg that has it, in SI.

    `peak` is a value the law takes, at `time` [s] in `segment`; `upper` a bound it never exceeds,
    rounding included. The limit holds if `upper` ≤ `bound`; no tolerance. `order` is the highest
    rate that enters it. A `note` says where more is demanded than the limit itself.
    """

    limit: str
    bound: float
    peak: float
    upper: float
    time: float
    segment: str
    unit: str
    order: int
    note: str = ""

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


def check_limits(law: QuaternionLaw) -> tuple[LimitCheck, ...]:
    """Every limit that the law carries, axis by axis where it is given so, general ones first."""
    groups: dict[str, list[tuple[Segment, Quantity]]] = defaultdict(list)
    for segment in law.segments:
        for label, quantity in law.quantities(segment):
            groups[label].append((segment, quantity))
    names = sorted(groups, key=lambda label: " on " in label)
    return tuple(_check(name, groups[name]) for name in names)


def _check(label: str, places: list[tuple[Segment, Quantity]]) -> LimitCheck:
    """Enclose the largest value of one limit's rows; squares are given back as what they are squares of."""
    tops = enclose_peaks([quantity.value for _, quantity in places])
    highest = max(range(len(tops)), key=lambda i: tops[i].lower)
    (segment, quantity), top = places[highest], tops[highest]
    row = quantity.row
    tau = float(quantity.start + top.at * (quantity.end - quantity.start))
    return LimitCheck(
        label,
        row.size(row.bound),
        row.size(top.lower),
        # NumPy's maximum of what is not a number is not a number
        float(np.max([row.size(top.upper) for top in tops])) * ROUNDING,
        segment.start_time + segment.duration * tau,
        segment.name,
        row.unit,
        max(row.orders),
        row.note,
    )
