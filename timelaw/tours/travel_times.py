"""How long legs and runs take at least under limits, before there is a route to choose."""

from collections.abc import Collection, Mapping, Sequence
from functools import cache, cached_property
from itertools import chain, pairwise
from math import inf

import numpy as np

from timelaw.errors import Fault, InputError
from timelaw.least_time.physical_limit import run_limit
from timelaw.least_time.snap import snap_times
from timelaw.limits import Demand, Limit, Row, drop_implied, list_rows
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between
from timelaw.numerics.turn import find_turn
from timelaw.progress import Progress
from timelaw.tours.graph.straight_runs import StraightRuns
from timelaw.tours.search.costs import Indices

BLOCK = 256  # rows of legs at a time: a few tens of megabytes also for thousands of orientations
MOST_RUNS = 20_000
MOST_RUNS_WITH_TORQUE = 4000  # most of which are alike
MOST_TIMED = 5000  # nodes; the times of all legs are held
MOST_WITH_TORQUE = 60  # nodes; each leg is a quadrature of some 15 ms


class TravelTimes:
    """Least times [s] from rest to rest between orientations (N, 4), in closed form.

    The double-S profile under velocity, acceleration, jerk and momentum, the phase plane under
    torque. The body may go through the nodes `passable` at speed, and rests at all others. The limits
    `at` a node hold on the legs that meet there, besides the general ones. `rest` [s] is what any
    tour dwells in all; `precision` [rad] is that of the orientations.

    Raises:
        InputError: no limit bounds some leg, or there are too many, at all or for a torque limit.
    """

    def __init__(
        self,
        quaternions: Array,
        limits: Collection[Limit],
        passable: Collection[int],
        progress: Progress | None = None,
        at: Mapping[int, Sequence[Limit]] | None = None,
        rest: float = 0.0,
        precision: float = 0.0,
    ) -> None:
        if len(quaternions) > MOST_TIMED:
            most = f'"fastest" is searched for {MOST_TIMED} orientations at most, not for {len(quaternions)}'
            raise InputError(Fault(f'{most}; use "shortest", or give the tour', "route.tour"))
        self.rest, self.precision = rest, precision
        self.quaternions, self._limits, self._progress = quaternions, tuple(limits), progress
        self._at = at or {}
        self.straight_runs = StraightRuns(quaternions, passable, precision)
        self.run = cache(self._run)
        self._known: dict[object, float] = {}
        self.plain = not any(limit.couples for limit in chain(limits, *self._at.values()))

    @property
    def most_runs(self) -> int:
        """How many runs can be timed in some ten seconds."""
        return MOST_RUNS if self.plain else MOST_RUNS_WITH_TORQUE

    @cached_property
    def legs(self) -> Array:
        """Least times (N, N) of single legs."""
        count = len(self.quaternions)
        if self.plain:
            blocks = [self._rows(slice(at, at + BLOCK))[0] for at in range(0, count, BLOCK)]
            times = np.concatenate(blocks)
            np.fill_diagonal(times, 0.0)
            if not np.all((times > 0) | np.eye(count, dtype=bool)):
                raise InputError(Fault("no limit bounds the motion of some legs; add a norm limit", "limits"))
            return np.minimum(times, times.T)  # equal but for rounding
        if count > MOST_WITH_TORQUE:
            message = (
                f"with a torque limit, {MOST_WITH_TORQUE} orientations at most can be timed, not {count}"
            )
            raise InputError(Fault(message, "route.tour"))
        times = np.zeros((count, count))
        for i in range(count):
            for j in range(i):
                times[i, j] = times[j, i] = self._run((j, i))
            if self._progress is not None:
                self._progress("times of legs", i, count)
        return times

    @cached_property
    def cruise(self) -> Array:
        """Times (N, N) at the velocity limit all along, which no run beats; 0 where there is none."""
        blocks = [self._rows(slice(at, at + BLOCK)) for at in range(0, len(self.quaternions), BLOCK)]
        return np.concatenate([angles / rates[0] for _, angles, rates in blocks])

    def bound_rates(self, origins: Indices, targets: Indices) -> tuple[Array, Array, Array, Array]:
        """Bounds on the rates of the angle on legs (M,), those of the limits that hold everywhere."""
        axes = find_turn(self.quaternions[origins], self.quaternions[targets]).axis
        bounds = [np.full(len(axes), inf) for _ in range(4)]
        for limit in self._limits:
            for order, found in limit.bound_rates(axes).items():
                np.minimum(bounds[order - 1], found, out=bounds[order - 1])
        return bounds[0], bounds[1], bounds[2], bounds[3]

    def _rows(self, rows: slice) -> tuple[Array, Array, list[Array]]:
        """Times, angles and bounds on the rates of the angle, of the legs from some of the orientations."""
        q = self.quaternions
        axes, angles, _ = find_turn(q[rows][:, None, :], q[None, :, :])
        bounds = [np.full(angles.shape, inf) for _ in range(4)]
        everywhere, first = slice(None), rows.start
        parts = [(limit, everywhere, everywhere) for limit in self._limits]
        for node, limits in self._at.items():
            parts += [(limit, everywhere, slice(node, node + 1)) for limit in limits]
            if first <= node < first + len(angles):
                parts += [(limit, slice(node - first, node - first + 1), everywhere) for limit in limits]
        for limit, these, those in parts:
            for order, found in limit.bound_rates(axes[these, those]).items():
                bound = bounds[order - 1][these, those]
                np.minimum(bound, found, out=bound)
        times = snap_times(angles, (bounds[0], bounds[1], bounds[2], bounds[3]))
        return np.where(np.isfinite(times), times, 0.0), angles, bounds

    def _run(self, visits: tuple[int, ...]) -> float:
        """Least time over visits about one axis."""
        q = self.quaternions[list(visits)]
        angles, axis = angle_between(q[:-1], q[1:]), find_turn(q[0], q[1]).axis
        if not any(node in self._at for node in visits):
            demands = [Demand(float(np.sum(angles)), drop_implied(list_rows(self._limits, axis)))]
        else:
            demands = [
                Demand(float(angle), self._rows_between(i, j, axis))
                for angle, (i, j) in zip(angles, pairwise(visits), strict=True)
            ]
        key = tuple(demand.key() for demand in demands)
        if key not in self._known:
            self._known[key] = run_limit(demands)
        return self._known[key]

    def _rows_between(self, i: int, j: int, axis: Array) -> tuple[Row, ...]:
        """All rows on the leg between two nodes."""
        return drop_implied(list_rows((*self._limits, *self._at.get(i, ()), *self._at.get(j, ())), axis))
