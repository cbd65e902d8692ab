"""Limits proved for all t: extrema of the law's polynomials, enclosed, against the bounds."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.limits import Rate, limits_of
from timelaw.motion import QuaternionLaw
from timelaw.numerics.extrema import peaks


@dataclass(frozen=True)
class LimitCheck:
    """One limit over the whole motion, in SI.

    `peak` is a value the law takes, at `time` [s] in `segment`; `upper` a bound it never exceeds,
    rounding included. The limit holds if `upper` ≤ `bound`; no tolerance.
    """

    limit: str
    bound: float
    peak: float
    upper: float
    time: float
    segment: str
    unit: str

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
    """Every limit that the law carries."""
    return tuple(check_limit(law, limit) for limit in limits_of(law.limits))


def check_limit(law: QuaternionLaw, limit: Rate) -> LimitCheck:
    """Enclose the largest value of a limit's rows over all segments and intervals."""
    polynomials, errors, places = [], [], []
    for index, segment in enumerate(law.segments):
        rates = {k: segment.rates(k) for k in limit.orders}
        for piece in range(len(segment.easing.pieces)):
            rows = limit.rows({k: r[piece][0] for k, r in rates.items()})
            rounding = limit.rows({k: r[piece][1] for k, r in rates.items()})
            polynomials += [row.value for row in rows]
            errors += [row.value for row in rounding]
            places += [(index, piece)] * len(rows)
    tops = peaks(polynomials)
    uppers = [top.upper + error for top, error in zip(tops, errors, strict=True)]
    highest = max(range(len(tops)), key=lambda i: tops[i].lower)
    index, piece = places[highest]
    segment = law.segments[index]
    return LimitCheck(
        limit.name,
        limit.bound,
        tops[highest].lower,
        max(uppers),
        segment.start_time + segment.duration * _tau(segment.easing.breaks, piece, tops[highest].at),
        segment.name,
        limit.unit,
    )


def _tau(breaks: NDArray[np.float64], piece: int, local: float) -> float:
    """τ of a point of an interval, [0, 1] within it."""
    return float(breaks[piece] + local * (breaks[piece + 1] - breaks[piece]))
