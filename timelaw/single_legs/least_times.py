"""The fastest laws over single legs from rest to rest: found all at once, each stretched to its limits."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from timelaw.easing import Timing
from timelaw.easing.polynomial_basis import PolynomialBasis
from timelaw.easing.time_scaling import fit_runs
from timelaw.least_time.constant_bounds import rate_bounds
from timelaw.limits import Demand
from timelaw.single_legs.one_point_exchange import find_least_times
from timelaw.single_legs.symmetric_easings import SymmetricEasings


@dataclass(frozen=True)
class Fastest:
    """A law within its limits, how far above the proved least time it is, and what it took to find it.

    `rows` hold with equality at the optimum, `exchanges` came in until they were found.
    """

    timing: Timing
    gap: float
    exchanges: int
    rows: int


def are_rates_limited(demand: Demand) -> bool:
    """Whether all that is demanded are bounds on single rates."""
    return demand.duration is None and not any(row.couples for row in demand.rows)


def solve_legs(demands: Sequence[Demand], basis: PolynomialBasis) -> list[Fastest | None]:
    """The fastest law of each leg in a basis; None where rounding ended the search."""
    easings = _make_easings(basis.degree, basis.continuity)
    bounds = np.array([rate_bounds(demand.rows) for demand in demands])
    least = find_least_times(easings, bounds / np.array([[demand.angle] for demand in demands]))
    solved = np.flatnonzero(np.isfinite(least.bound)).tolist()
    profiles = easings.write_in(basis, least.chosen[solved])
    laws = [[Timing(float(least.bound[i]), easing)] for i, easing in zip(solved, profiles, strict=True)]
    found: list[Fastest | None] = [None] * len(demands)
    for i, (timing,) in zip(solved, fit_runs([[demands[i]] for i in solved], laws), strict=True):
        gap = timing.duration / least.bound[i] - 1
        found[i] = Fastest(timing, max(float(gap), 0.0), int(least.exchanges[i]), easings.free + 1)
    return found


@cache
def _make_easings(degree: int, continuity: int) -> SymmetricEasings:
    return SymmetricEasings(degree, continuity)
