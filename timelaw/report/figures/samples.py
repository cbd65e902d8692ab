"""A law at many instants: its rates as arrays, from which all that is drawn over time follows."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from timelaw.certificate import Certificate
from timelaw.limits import LIMITS
from timelaw.limits.formula import LINEAR
from timelaw.limits.registry import POINT
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import rotation_matrix

POINTS = 24_000  # in all, shared by the intervals between breaks
FEWEST, MOST = 13, 193  # of an interval
TRAVELS = (1, 2)  # orders of the origin's rates that are limited
DRAWN = 3  # the highest rate that is drawn without being asked for


@dataclass(frozen=True)
class Samples:
    """Instants `times` (n,) [s] of segments, both sides of every break among them.

    `rates` are the components (3, n) of ω, α, … by order, and of the origin's rates by their keys;
    `momentum` is H (n, 3) in body axes, `begins` the first instant of each segment.
    """

    segments: tuple[Segment, ...]
    times: Array
    begins: NDArray[np.intp]
    rates: Mapping[int, list[Array]]
    momentum: Array


def sample_motion(
    law: QuaternionLaw, segments: Sequence[Segment], certificate: Certificate | None = None
) -> Samples:
    """Evenly between breaks, and at the instants of all proved peaks, so that none is missed."""
    peaks: dict[int, list[float]] = defaultdict(list)
    for peak in certificate.peaks if certificate is not None else ():
        peaks[id(law.segments[peak.index])].append(peak.time)
    intervals = sum(len(segment.breaks) - 1 for segment in segments)
    count = int(np.clip(POINTS // intervals, FEWEST, MOST))
    given = {name for limits in (law.limits, *(s.limits for s in law.segments)) for name in limits}
    highest = max([DRAWN, *(_find_order(law, name) for name in given if name in LIMITS)])
    times, begins, found = [], [0], []
    for segment in segments:
        extra = [(t - segment.start_time) / segment.duration for t in peaks[id(segment)]]
        tau, ends = _place(segment, count, extra)
        times.append(segment.start_time + segment.duration * tau)
        begins.append(begins[-1] + len(tau))
        found.append(_evaluate(law, segment, tau, ends, highest))
    rates = {key: list(np.concatenate([part[key] for part in found]).T) for key in found[0]}
    momentum = np.stack(rates.pop(0), axis=-1)
    return Samples(tuple(segments), np.concatenate(times), np.array(begins[:-1]), rates, momentum)


def _find_order(law: QuaternionLaw, name: str) -> int:
    """The highest rate that enters a limit."""
    return LIMITS[name].make(1.0, law.body or POINT).highest


def _place(segment: Segment, count: int, extra: Sequence[float]) -> tuple[Array, list[int]]:
    """τ (m,), so many between two breaks, and which of them end an interval; two where the body rests."""
    if not segment.moves:
        return np.array([0.0, 1.0]), [1]
    grids, ends = [], []
    for start, end in pairwise(segment.breaks):
        inner = [t for t in extra if start < t < end]
        grids.append(np.sort(np.concatenate([np.linspace(start, end, count), inner])))
        ends.append(sum(len(grid) for grid in grids) - 1)
    return np.concatenate(grids), ends


def _evaluate(
    law: QuaternionLaw, segment: Segment, tau: Array, ends: list[int], highest: int
) -> dict[int, Array]:
    """The rates (m, 3) by their keys, from inside of every interval; by 0 the momentum."""
    found = {}
    for order in range(1, highest + 1):
        found[order] = segment(tau, order, "right")
        found[order][ends] = segment(tau[ends], order, "left")
    for order in TRAVELS:
        found[LINEAR[order]] = np.zeros((len(tau), 3))
        if segment.travels:
            found[LINEAR[order]] = segment.place(tau, order, "right")
            found[LINEAR[order]][ends] = segment.place(tau[ends], order, "left")
    found[0] = _turn_momentum(law, segment, tau)
    return found


def _turn_momentum(law: QuaternionLaw, segment: Segment, tau: Array) -> Array:
    """H (m, 3) in body axes: constant in the world, where the first orientation has put it."""
    if law.body is None or not law.body.total_momentum:
        return np.zeros((len(tau), 3))
    world = rotation_matrix(law.segments[0].start) @ law.body.momentum
    return np.asarray(np.einsum("mij,i->mj", rotation_matrix(segment(tau, 0, "right")), world))
