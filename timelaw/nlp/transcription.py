"""Runs as a nonlinear program: rows at chosen points τ, in numbers, and how they are laid out.

Rows are divided by their bounds and written θ f^(k)/T^k ≤ bound (with T^k on the other side IPOPT
needs several times the iterations). Nothing is symbolic here: programs of one layout share their functions.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from timelaw.interrupts import check_interrupted
from timelaw.nlp.assembly import Layout
from timelaw.nlp.monomials import expand_monomials
from timelaw.nlp.point_rows import Form, PointRows, sort_rows
from timelaw.nlp.program import FARTHEST, Program
from timelaw.nlp.terms import list_effort_rows, weigh_terms
from timelaw.nlp.variables import LegVariables, Variables
from timelaw.numerics.array import Array

Points = list[list[Array]]  # points[leg][row]: where that row is demanded on that leg
LEAST_DURATION = 1e-6  # in units of the start's duration of that leg, which itself holds the limits
MOST_DURATION = 4.0  # of its run's start, half a turn longer: no leg needs more to hold its limits


@dataclass(frozen=True)
class Transcription:
    """A layout with its numbers: parameters and bounds; `rows` says how many of them are of limits."""

    layout: Layout
    numbers: dict[str, Array]
    rows: int


def transcribe(
    program: Program,
    variables: Variables,
    points: Points,
    rooms: Points,
    stay: Sequence[Array],
    effort_scale: float,
) -> Transcription:
    """The program with limits demanded at the given points, `rooms` times the bounds there.

    Easings are held from 0 to 1 at the points τ in `stay`. `effort_scale` is the size of the objective at the
    start: of an effort, or of the used part of the limits.
    """
    peak = variables.size - 1
    limits: list[PointRows] = []
    for leg, taus, parts in zip(variables.legs, points, rooms, strict=True):
        check_interrupted()
        limits += _limit_rows(program, leg, taus, parts, effort_scale)
    stays = [
        _stay_near_arc(program, leg, tau) for leg, tau in zip(variables.legs, stay, strict=True) if len(tau)
    ]
    unit_time = float(np.average(variables.units, weights=program.leg_counts))
    weights = weigh_terms(program, effort_scale)
    made = variables.units * np.array(program.leg_counts)
    cost = np.zeros(variables.size)
    cost[: len(made)] = weights.time * made / unit_time
    if program.objective.scales_limits:
        cost[peak] = weights.used_part
    efforts = list_effort_rows(program, variables.legs, weights.efforts, effort_scale)
    limited, near, summed = sort_rows(limits, peak), sort_rows(stays, peak), sort_rows(efforts, peak)
    held = [*limited, *near]
    sums = tuple(budget.legs for budget in program.budgets)
    layout = Layout(
        variables.size, tuple(rows.block for rows in held), tuple(rows.block for rows in summed), sums
    )
    times = [made[: budget.legs] / budget.time for budget in program.budgets]
    ones = np.ones(len(times))
    numbers = {
        **_variable_bounds(program, variables),
        "p": np.concatenate([cost, *(rows.parameters.ravel() for rows in (*held, *summed)), *times]),
        "lbg": np.concatenate([*(rows.lower for rows in held), ones]),
        "ubg": np.concatenate([*(rows.upper for rows in held), ones]),
    }
    return Transcription(layout, numbers, sum(rows.block.size for rows in limited))


def _limit_rows(
    program: Program, leg: LegVariables, points: Sequence[Array], rooms: Sequence[Array], scale: float
) -> list[PointRows]:
    """Rows of one leg over their bounds; or, where these are scaled, on both sides within what is used."""
    found = []
    for row, tau, room in zip(leg.demand.rows, points, rooms, strict=True):
        exponents, coefficients = expand_monomials(row.value, row.orders)
        over = np.tile(np.array(coefficients) / row.bound, (len(tau), 1))
        if not program.objective.scales_limits:
            found.append(PointRows(leg, Form(row.orders, exponents), tau, over, -room, room))
            continue
        form, over = Form(row.orders, exponents, root=row.root), over / scale**row.root
        nothing, below = np.zeros(len(tau)), np.full(len(tau), -np.inf)
        found += [PointRows(leg, form, tau, sign * over, below, nothing) for sign in (1.0, -1.0)]
    return found


def _stay_near_arc(program: Program, leg: LegVariables, tau: Array) -> PointRows:
    """The easing of a leg at points τ, and how far below 0 and above 1 it may be there.

    From rest to rest it stays between by itself; where a leg has time to spend, a long run-up would pay.
    """
    beyond = np.full(len(tau), program.beyond / leg.demand.angle)
    scale = np.full((len(tau), 1), 1 / leg.demand.angle)
    return PointRows(leg, Form((0,), ((1,),)), tau, scale, -beyond, 1 + beyond)


def _variable_bounds(program: Program, variables: Variables) -> dict[str, Array]:
    """Durations stay positive, and fixed ones fixed; the used part of the limits is not negative.

    The less of the limits is to be used, the longer a leg may take: without an end to that the solver would
    let the body creep for ever.
    """
    legs = len(variables.units)
    lower, upper = np.full(variables.size, -np.inf), np.full(variables.size, np.inf)
    lower[:legs] = LEAST_DURATION
    if program.objective.scales_limits:
        upper[:legs] = _list_longest(program, variables.units)
        lower[-1] = 0.0
    for k, demand in enumerate(program.demands):
        if demand.duration is not None:
            lower[k] = upper[k] = demand.duration / variables.units[k]
    return {"lbx": lower, "ubx": upper}


def _list_longest(program: Program, units: Array) -> Array:
    """For each leg the longest that its run may ever need, in units of its start."""
    longest: list[float] = []
    for run in program.runs:
        own = units[len(longest) : len(longest) + len(run.demands)]
        further = 1 + FARTHEST / run.run.angle
        longest += [MOST_DURATION * further * float(np.sum(own))] * len(own)
    return np.array(longest) / units
