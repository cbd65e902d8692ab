"""A problem in words: what limits the motion, what turns the body, what its nodes ask, what is made least."""

from collections.abc import Iterable, Mapping
from math import degrees, isfinite

from timelaw.errors import list_some
from timelaw.limits import LIMITS, Bounds
from timelaw.limits.row import ORDERS
from timelaw.objectives import OBJECTIVES
from timelaw.problem import Problem
from timelaw.problem.nodes import EndRates, NodeRule, SegmentRule
from timelaw.problem.objective import Goal
from timelaw.units import convert, name_unit

ACTUATORS = {"external": "a torque from outside", "wheels": "reaction wheels"}
CONTINUOUS = ("orientation", "ω", "ω and α", "ω, α and jerk", "ω, α, jerk and snap")  # by the class C^k


def describe_limits(limits: Mapping[str, Bounds]) -> str:
    """Each limit with its bounds, angles in degrees."""
    return ", ".join(f"{_name(key)} {_describe_bounds(key, bounds)}" for key, bounds in limits.items())


def _name(key: str) -> str:
    return f"angular {key}" if key in ORDERS else key.replace("_", " ")


def _describe_bounds(key: str, bounds: Bounds) -> str:
    kind = LIMITS[key]
    unit = (
        name_unit(kind.quantity.unit, degrees=True).replace("^2", "²").replace("^3", "³").replace("^4", "⁴")
    )
    unit = unit.replace("*", "·")
    values = bounds if isinstance(bounds, tuple) else (bounds,)
    shown = ", ".join(f"{convert(value, kind.quantity.unit, degrees=True):.6g}" for value in values)
    if len(values) == 1:
        return f"{shown} {unit}"
    return f"{shown} {unit} {'along the axes of the world' if kind.needs_translation else 'about x, y, z'}"


def describe_objective(goal: Goal) -> str:
    """The objective in words."""
    objective = OBJECTIVES[goal.minimise]
    if not objective.takes:
        return f"least {objective.words}"
    if goal.total_time is None:
        return f"least time plus {goal.weight:g} times {goal.minimise}, each relative to the least-time law"
    unit = "times the least time" if goal.total_time.relative else "s"
    return f"least {objective.words} in a total time of {goal.total_time.value:g} {unit}"


def describe_problem(problem: Problem) -> list[str]:
    """What is asked of a motion, whatever its route, one sentence each."""
    told = [f"Limits at every instant: {describe_limits(problem.limits.given())}."]
    told += _describe_segments(problem.segments)
    told += _describe_body(problem)
    told += _describe_nodes(problem)
    told.append(f"Objective: {describe_objective(problem.objective)}.")
    return told


def _describe_segments(rules: Mapping[str, SegmentRule]) -> list[str]:
    """Limits and durations of single legs."""
    parts = []
    for leg, rule in rules.items():
        own = [f"at most {describe_limits(rule.limits.given())}"] if rule.limits else []
        own += [f"in {rule.duration:g} s"] if rule.duration is not None else []
        parts.append(f"{leg} {' and '.join(own)}")
    return [f"Besides, on single legs: {list_some(parts)}."] if parts else []


def _describe_body(problem: Problem) -> list[str]:
    body = problem.rigid_body()
    if body is None or problem.body is None:
        return []
    rows = body.inertia.tolist()
    moments = [rows[k][k] for k in range(3)]
    full = any(rows[i][j] for i in range(3) for j in range(3) if i != j)
    what = "moments of inertia about x, y, z" if not full else "inertia, its diagonal"
    told = f"The body is turned by {ACTUATORS[problem.body.actuator]}; {what}: "
    told += f"{', '.join(f'{m:g}' for m in moments)} kg·m²"
    if any(problem.body.momentum):
        told += f"; total momentum {', '.join(f'{m:g}' for m in problem.body.momentum)} N·m·s"
    return [f"{told}."]


def _describe_nodes(problem: Problem) -> list[str]:
    nodes = problem.nodes
    told = [f"The motion is to be C{nodes.continuity}: {CONTINUOUS[nodes.continuity]} without jumps."]
    if nodes.dwell:
        told.append(f"At every node the body rests for {nodes.dwell:g} s.")
    rules = [f"{label} {_describe_rule(rule)}" for label, rule in nodes.at.items()]
    told += [f"At single nodes: {list_some(rules)}."] if rules else []
    if nodes.periodic:
        told.append("The motion goes round: it begins as it ends.")
    ends = (("begins", nodes.moving_start), ("ends", nodes.end))
    told += [f"It {verb} moving: {_describe_rates(rates)}." for verb, rates in ends if rates]
    return told


def _describe_rule(rule: NodeRule) -> str:
    parts = [f"a dwell of {rule.dwell:g} s"] if rule.dwell is not None else []
    parts += ["a stop"] if rule.stop else []
    parts += [f"reached at {rule.time:g} s"] if rule.time is not None else []
    parts += [f"limits {describe_limits(rule.limits.given())}"] if rule.limits else []
    return f"({'; '.join(parts)})"


def _describe_rates(rates: EndRates) -> str:
    given = (
        ("velocity", rates.velocity, "deg/s"),
        ("acceleration", rates.acceleration, "deg/s²"),
        ("jerk", rates.jerk, "deg/s³"),
    )
    return ", ".join(f"{name} {_list_degrees(value)} {unit}" for name, value, unit in given if value)


def _list_degrees(value: float | Iterable[float]) -> str:
    values = (value,) if isinstance(value, int | float) else value
    return ", ".join(f"{degrees(v):.6g}" for v in values if isfinite(v))
