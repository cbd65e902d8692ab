"""Runs as a nonlinear program in CasADi: scaled variables, labelled rows.

Variables, all of order one: durations T_k in units of those of the start; at each straight node
the rates φ', φ'', …, φ^(r), in units of the run's mean angle over its mean duration^i, shared by
the legs on both sides, so that continuity holds by construction; the free coefficients of each
leg; for the objective `peak` the used part of the limits. Rows: those of the limits at chosen
points τ, divided by their bounds and written θ f^(k)/T^k ≤ bound (with T^k on the other side IPOPT
needs several times the iterations).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any

import casadi as ca
import numpy as np

from timelaw.easing import Timing
from timelaw.easing.family import Basis
from timelaw.interrupts import check_interrupted, shield
from timelaw.limits import Demand
from timelaw.nlp.leg_symbols import LegSymbols, rates_at
from timelaw.nlp.program import FARTHEST, Program, RunProblem
from timelaw.nlp.terms import Terms
from timelaw.numerics.array import Array

Points = list[list[Array]]  # points[leg][row]: where that row is demanded on that leg
LEAST_DURATION = 1e-6  # in units of the start's duration of that leg, which itself holds the limits
MOST_DURATION = 4.0  # of its run's start, half a turn longer: no leg needs more to hold its limits


@dataclass(frozen=True)
class Transcription:
    """Symbols and bounds of the program, and the way from its variables back to timings."""

    program: Program
    symbols: dict[str, Any]
    bounds: dict[str, Array]
    unpack: Any
    rows: int

    def timings(self, x: Array) -> tuple[Timing, ...]:
        """Timings of the legs from the variables (n,) of a solution."""
        with shield():
            durations, *parts = [np.array(part).ravel() for part in self.unpack(x)]
        legs = zip(durations, self.program.bases, parts[::3], parts[1::3], parts[2::3], strict=True)
        return tuple(Timing(float(t), basis.easing(*coefficients)) for t, basis, *coefficients in legs)


@shield()
def transcribe(
    program: Program, points: Points, rooms: Points, stay: Sequence[Array], units: Array, effort_scale: float
) -> Transcription:
    """Build the program with limits demanded at the given points, `rooms` times the bounds there.

    Easings are held from 0 to 1 at the points τ in `stay`. `effort_scale` is the size of the objective at the
    start: of an effort, or of the used part of the limits.
    """
    demands = program.demands
    sizes = [len(demands), *(_sizes(run) for run in program.runs), 1]
    x = ca.MX.sym("x", sum(sizes))
    durations, *parts, peak = ca.vertsplit(x, [0, *accumulate(sizes)])
    legs: list[LegSymbols] = []
    for run, part in zip(program.runs, parts, strict=True):
        own = slice(len(legs), len(legs) + len(run.demands))
        legs += _run(run, durations[own] * ca.DM(units[own]), part, units[own])
    rows = [
        row
        for demand, leg, basis, tau in zip(demands, legs, program.bases, points, strict=True)
        for row in _limit_rows(demand, leg, basis, tau)
    ]
    with_peak = program.objective.scales_limits
    g = ca.vertcat(*(value for value, _ in rows))
    if with_peak:
        unit = ca.vertcat(*(ca.repmat(ca.DM(effort_scale**root), value.numel(), 1) for value, root in rows))
        used = ca.vertcat(*(ca.repmat(peak**root, value.numel(), 1) for value, root in rows))
        g = ca.vertcat(g / unit - used, -g / unit - used)
    seconds = ca.vertcat(*(leg.duration for leg in legs))
    made = seconds * ca.DM(program.leg_counts)
    times = [ca.sum1(made[: budget.legs]) / budget.time for budget in program.budgets]
    room = np.concatenate([part for leg_rooms in rooms for part in leg_rooms])
    upper = np.zeros(g.numel()) if with_peak else room
    lower = np.full(g.numel(), -np.inf) if with_peak else -upper
    near, beyond = _stay_near_arcs(program, legs, stay)
    ones = np.ones(len(times))
    bounds = {
        **_variable_bounds(program, units, sizes),
        "lbg": np.concatenate([lower, -beyond, ones]),
        "ubg": np.concatenate([upper, 1 + beyond, ones]),
    }
    unit_time = float(np.average(units, weights=program.leg_counts))
    objective = program.objective.expression(Terms(program, legs, unit_time, effort_scale, peak))
    symbols = {"x": x, "f": objective, "g": ca.vertcat(g, *near, *times)}
    coefficients = [part for leg in legs for part in (leg.left, leg.free, leg.right)]
    unpack = ca.Function("unpack", [x], [seconds, *coefficients])
    return Transcription(program, symbols, bounds, unpack, int(g.numel()))


def _stay_near_arcs(
    program: Program, legs: Sequence[LegSymbols], stay: Sequence[Array]
) -> tuple[list[Any], Array]:
    """The easing of each leg at the points τ in `stay`, and how far below 0 and above 1 it may be there.

    From rest to rest it stays between by itself; where a leg has time to spend, a long run-up would pay.
    """
    found, beyond = [], [np.zeros(0)]
    for demand, basis, leg, tau in zip(program.demands, program.bases, legs, stay, strict=True):
        if len(tau):
            found.append(ca.densify(leg.apply(basis, basis.values(tau, 0))))
            beyond.append(np.full(len(tau), program.beyond / demand.angle))
    return found, np.concatenate(beyond)


def _sizes(run: RunProblem) -> int:
    legs = len(run.demands)
    return run.family.continuity * (legs - 1) + sum(basis.free for basis in run.bases)


def _scale(run: RunProblem) -> float:
    return float(np.mean([demand.angle for demand in run.demands]))


def _run(run: RunProblem, durations: Any, part: Any, units: Array) -> list[LegSymbols]:
    """The legs of a run, joined at its straight nodes by shared rates."""
    count, r = len(run.demands), run.family.continuity
    scale, unit = _scale(run), float(np.mean(units))
    cuts = [0, *accumulate((basis.free for basis in run.bases), initial=r * (count - 1))]
    shared, *free = ca.vertsplit(part, cuts)  # CasADi's slices beyond a single element are not empty
    speeds: Any = ca.reshape(shared, r, count - 1)
    ends = [_end(rates, r, unit, scale) for rates in (run.start, run.end)]
    legs = []
    for k, demand in enumerate(run.demands):
        powers = ca.vertcat(*((durations[k] / unit) ** i * scale / demand.angle for i in range(1, r + 1)))
        before = speeds[:, k - 1] if k else ends[0]
        after = speeds[:, k] if k < count - 1 else ends[1]
        left, right = ca.vertcat(0.0, before * powers), ca.vertcat(1.0, after * powers)
        legs.append(LegSymbols(durations[k], left, free[k], right))
    return legs


def _end(rates: Sequence[float], continuity: int, unit: float, scale: float) -> Any:
    """Rates outside a run in the units of its node variables; rest where none are given."""
    given = [*rates, *[0.0] * continuity][:continuity]
    return ca.DM([rate * unit**i / scale for i, rate in enumerate(given, 1)])


def _limit_rows(
    demand: Demand, leg: LegSymbols, basis: Basis, points: Sequence[Array]
) -> list[tuple[Any, int]]:
    """Rows of one leg over their bounds, each with its root."""
    check_interrupted()
    rows = []
    for row, tau in zip(demand.rows, points, strict=True):
        rates = rates_at(demand.angle, leg, basis, tau, row.orders)
        rows.append((ca.densify(row.value(rates) / row.bound), row.root))
    return rows


def _variable_bounds(program: Program, units: Array, sizes: Sequence[int]) -> dict[str, Array]:
    """Durations stay positive, and fixed ones fixed; the used part of the limits is not negative.

    The less of the limits is to be used, the longer a leg may take: without an end to that the solver would
    let the body creep for ever.
    """
    lower, upper = np.full(sum(sizes), -np.inf), np.full(sum(sizes), np.inf)
    lower[: sizes[0]] = LEAST_DURATION
    if program.objective.scales_limits:
        upper[: sizes[0]] = _list_longest(program, units)
    for k, demand in enumerate(program.demands):
        if demand.duration is not None:
            lower[k] = upper[k] = demand.duration / units[k]
    lower[-1], upper[-1] = 0.0, (np.inf if program.objective.scales_limits else 0.0)
    return {"lbx": lower, "ubx": upper}


def _list_longest(program: Program, units: Array) -> Array:
    """For each leg the longest that its run may ever need, in units of its start."""
    longest: list[float] = []
    for run in program.runs:
        own = units[len(longest) : len(longest) + len(run.demands)]
        further = 1 + FARTHEST / run.run.angle
        longest += [MOST_DURATION * further * float(np.sum(own))] * len(own)
    return np.array(longest) / units


def pack(program: Program, timings: Sequence[Timing], units: Array, peak: float) -> Array:
    """Variables (n,) of given timings whose easings the bases contain."""
    parts: list[Any] = [[timing.duration / unit for timing, unit in zip(timings, units, strict=True)]]
    first = 0
    for run in program.runs:
        own = timings[first : first + len(run.demands)]
        scale, unit = _scale(run), float(np.mean(units[first : first + len(own)]))
        parts.append(
            [
                timing.easing.end(i) * demand.angle / (timing.duration / unit) ** i / scale
                for timing, demand in zip(own[:-1], run.demands, strict=False)
                for i in range(1, run.family.continuity + 1)
            ]
        )
        parts += [basis.free_of(timing.easing) for basis, timing in zip(run.bases, own, strict=True)]
        first += len(own)
    return np.concatenate([*parts, [peak if program.objective.scales_limits else 0.0]])
