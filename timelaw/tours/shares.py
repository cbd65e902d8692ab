"""What a leg can cost at least as a part of any run, where runs are too many to time them all.

A run of m legs turns the body by the angle of one of them and, for the a legs before and b after it, by as
much as it takes to go through a nodes back and b nodes on along the great circle, none left out. T of the
least such sum with a + b = m - 1, in m equal shares, is a bound on what the leg costs.
"""

from collections.abc import Sequence
from itertools import chain

import numpy as np

from timelaw.least_time.snap import snap_times
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between
from timelaw.numerics.turn import SAME_AXIS
from timelaw.tours.graph.straight_runs import Reach
from timelaw.tours.search.costs import Indices
from timelaw.tours.travel_times import TravelTimes

SENSES = (0, 1)  # of a half-turn, which may go on either way; any other leg has the first
MOST_STEPS = 24  # before and after a leg that are added up; more of them turn the body by the least each


def bound_shares(travel: TravelTimes) -> Array:
    """Times (N, N) [s] of legs of which no run has less in equal shares; those of single legs at most.

    Where an axis is known roughly only, or limits do not bound rates, runs are taken to be cruised through.
    """
    shares = travel.legs.copy()
    pairs = np.array(sorted({(min(leg), max(leg)) for leg in travel.straight_runs.legs()}), dtype=np.intp)
    low, high = pairs.T
    if travel.plain and travel.precision <= SAME_AXIS:
        in_runs = _share(travel, pairs)
    else:
        in_runs = travel.cruise[low, high]
    shares[low, high] = shares[high, low] = np.minimum(in_runs, shares[low, high])
    return shares


def _share(travel: TravelTimes, pairs: Indices) -> Array:
    """The least equal share (M,) of legs (M, 2) in runs of two legs and more."""
    angles = angle_between(travel.quaternions[pairs[:, 0]], travel.quaternions[pairs[:, 1]])
    runs, count = travel.straight_runs, len(travel.quaternions)
    known: dict[Reach, tuple[Array, float]] = {}
    turned, step = np.empty((2, MOST_STEPS + 1, len(pairs))), np.empty(len(pairs))
    most = np.zeros(len(pairs), dtype=int)
    for row, (i, j) in enumerate(pairs.tolist()):
        sides = [[runs.look_ahead((*leg, sense)) for sense in SENSES] for leg in ((i, j), (j, i))]
        for reach in chain(*sides):
            if reach not in known:
                known[reach] = _add_up(travel, reach)
        for side, reaches in enumerate(sides):
            turned[side, :, row] = np.minimum(*(known[reach][0] for reach in reaches))
        step[row] = min(known[reach][1] for reach in chain(*sides))
        most[row] = _count_others(sides, count)
    bounds = travel.bound_rates(pairs[:, 0], pairs[:, 1])
    least = np.full(len(pairs), np.inf)
    for others in range(1, MOST_STEPS + 1):
        there = np.flatnonzero(others <= most)
        ways = turned[0, : others + 1, there] + turned[1, others::-1, there]
        part = [bound[there] for bound in bounds]
        times = snap_times(angles[there] + np.min(ways, axis=1), (part[0], part[1], part[2], part[3]))
        least[there] = np.minimum(least[there], times / (others + 1))
    longer = most > MOST_STEPS
    mean = np.minimum((angles + MOST_STEPS * step) / (MOST_STEPS + 1), step)
    least[longer] = np.minimum(least[longer], (mean / bounds[0])[longer])
    return least


def _count_others(sides: Sequence[Sequence[Reach]], count: int) -> int:
    """How many more legs a run can have that passes a leg, given what lies ahead of it on both sides.

    Round a ring of m nodes it has m - 1 in all, and m if these are all there are.
    """
    rings = [len(reach.steps) for reach in chain(*sides) if reach.ring]
    if rings:
        return max(rings) - (1 if max(rings) == count else 2)
    return sum(max(len(reach.steps) for reach in reaches) for reaches in sides)


def _add_up(travel: TravelTimes, reach: Reach) -> tuple[Array, float]:
    """The angle [rad] turned after 0, 1, … MOST_STEPS steps of what lies ahead, infinite where it ends.

    And the least of all the steps.
    """
    turned = np.full(MOST_STEPS + 1, np.inf)
    turned[0] = 0.0
    if not reach.steps:
        return turned, np.inf
    first, last = np.array(reach.steps).T
    steps = angle_between(travel.quaternions[first], travel.quaternions[last])
    added = np.cumsum(steps)[:MOST_STEPS]
    turned[1 : 1 + len(added)] = added
    return turned, float(np.min(steps))
