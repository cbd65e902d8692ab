"""Limits proved for all t: extrema of the law's polynomials, enclosed, against the bounds."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from timelaw.limits import BoundRow
from timelaw.limits.row_peaks import RowPeak
from timelaw.motion import QuaternionLaw, Segment

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


@dataclass(frozen=True)
class LegPeak:
    """How near one segment, the `index`-th, comes to the limit called `label`: at `time` [s], in SI.

    `peak` is a value it takes, `upper` one that it never exceeds.
    """

    label: str
    index: int
    segment: str
    row: BoundRow
    peak: float
    upper: float
    time: float

    @property
    def bound(self) -> float:
        """The limit there."""
        return self.row.size(self.row.bound)

    @property
    def used(self) -> float:
        """The part of the limit that is used at most."""
        return self.upper / self.bound

    def to_dict(self) -> dict[str, Any]:
        """As the law file has it."""
        return {"limit": self.label, "upper": self.upper, "time": self.time, "margin": 1 - self.used}


def find_leg_peaks(law: QuaternionLaw) -> tuple[LegPeak, ...]:
    """For each segment and each limit there where the limit is nearest; segments in their order."""
    found = []
    for index, labelled in enumerate(law.find_peaks()):
        rows: dict[str, list[RowPeak]] = {}
        for label, peak in labelled:
            rows.setdefault(label, []).append(peak)
        found += [_join_rows(label, index, law.segments[index], peaks) for label, peaks in rows.items()]
    return tuple(found)


def _join_rows(label: str, index: int, segment: Segment, peaks: Sequence[RowPeak]) -> LegPeak:
    """The largest value of one limit's rows; a square is given back as what it is a square of."""
    top = max(peaks, key=lambda peak: peak.lower)
    size = top.row.size
    # NumPy's maximum of what is not a number is not a number
    upper = float(np.max([size(peak.upper) for peak in peaks])) * ROUNDING
    time = segment.start_time + segment.duration * top.at
    return LegPeak(label, index, segment.name, top.row, size(top.lower), upper, time)


def check_limits(peaks: Sequence[LegPeak]) -> tuple[LimitCheck, ...]:
    """Every limit that the law carries, axis by axis where it is given so, general ones first.

    Legs of one name may have limits of their own: each bound is a limit, but for what rounding makes of it.
    """
    groups: dict[tuple[str, str], list[LegPeak]] = defaultdict(list)
    for peak in peaks:
        groups[peak.label, f"{peak.bound:.12e}"].append(peak)
    names = sorted(groups, key=lambda key: " on " in key[0])
    return tuple(_check(groups[name]) for name in names)


def _check(peaks: Sequence[LegPeak]) -> LimitCheck:
    """One limit over all segments that have it."""
    top = max(peaks, key=lambda peak: peak.peak)
    row, upper = top.row, float(np.max([peak.upper for peak in peaks]))
    bound = min(peak.bound for peak in peaks)
    note = next((peak.row.note for peak in peaks if peak.row.note), "")
    return LimitCheck(
        top.label, bound, top.peak, upper, top.time, top.segment, row.unit, max(row.orders), note
    )
