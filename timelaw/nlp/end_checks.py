"""What a closed form says of a run that begins or ends moving, before a solver is asked."""

from math import inf

import numpy as np

from timelaw.errors import Fault, InfeasibleError
from timelaw.least_time.braking import changing_distance, list_reached, stopping_distance
from timelaw.least_time.constant_bounds import rate_bounds
from timelaw.limits.row import ORDERS
from timelaw.nlp.program import FARTHEST, RunProblem

OVER = 1e-9  # relative: a rate that is carried so little beyond its limit may be rounding
RATES = {order: name for name, order in ORDERS.items()}


def check_ends(problem: RunProblem) -> bool:
    """Whether a law might stay on the arcs, as far as the speeds of the run's ends say.

    Raises:
        InfeasibleError: none is possible, half a turn beyond the nodes included; or the rates at an end
            carry the body beyond a limit.
    """
    if not problem.run.moving:
        return True
    known = [rate_bounds(demand.rows) for demand in problem.demands]
    loosest = [max(bounds) for bounds in zip(*known, strict=True)]
    _check_reached(problem, loosest)
    return _check_braking(problem, loosest)


def _check_reached(problem: RunProblem, bounds: list[float]) -> None:
    """The rates at the ends must be able to turn before they break a limit."""
    for end, rates in (("start", problem.run.start), ("end", problem.run.end)):
        for order, reached in list_reached(rates, bounds, problem.family.continuity, backwards=end == "end"):
            if abs(reached) > bounds[order - 1] * (1 + OVER):
                top, bound = np.degrees([abs(reached), bounds[order - 1]])
                raise InfeasibleError(_explain_reached(end, order, top, bound))


def _explain_reached(end: str, order: int, top: float, bound: float) -> Fault:
    name, of, by = (RATES[order + k] for k in range(3))
    unit = "deg/s" if order == 1 else f"deg/s^{order}"
    way = "goes on to" if end == "start" else "has come from"
    message = (
        f"under the limit on the {by} a body with this {of} {way} {top:.9g} {unit} of {name} at least; "
        f"{bound:.9g} {unit} are allowed"
    )
    return Fault(message, f"nodes.{end}.{of}")


def _check_braking(problem: RunProblem, bounds: list[float]) -> bool:
    """The run must be long enough to change speed on the way, or for the faster end to stop and turn back."""
    run = problem.run
    moved = any((*problem.start[1:], *problem.end[1:]))
    jerk = inf if moved or problem.family.continuity < 2 else bounds[2]
    onwards = changing_distance(*run.speeds, bounds[1], jerk)
    stopping = stopping_distance(max(run.speeds), bounds[1], jerk)
    if onwards > run.angle and stopping > run.angle + FARTHEST:
        raise InfeasibleError(_explain_braking(problem, onwards, stopping))
    return min(onwards, stopping) <= run.angle


def _explain_braking(problem: RunProblem, onwards: float, stopping: float) -> Fault:
    run = problem.run
    ends = "slowing down" if run.speeds[0] > run.speeds[1] else "getting as fast as that"
    to_rest = min(run.speeds) == 0
    needed, has, turning = np.degrees([stopping if to_rest else onwards, run.angle, stopping])
    message = f"{ends} takes {needed:.6g}° at least under the limits; the run there has {has:.6g}°"
    message += "" if to_rest else f", and turning back on the way takes {turning:.6g}°"
    return Fault(f"{message}, half a turn beyond it at most", problem.where)
