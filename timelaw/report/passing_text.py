"""What came of a motion through the nodes, in sentences: what stopping would cost, how far arcs are left."""

from collections.abc import Sequence

import numpy as np

from timelaw.certificate.farthest import find_farthest
from timelaw.objectives import OBJECTIVES
from timelaw.pipeline import Design
from timelaw.report.rotation_spline import time_rotation_spline
from timelaw.route import Route
from timelaw.through.passage import Passage, Through
from timelaw.time_law.baselines import time_double_s, time_quintic

COUNT_STOPS = ("fastest", "fewest-stops")  # tours that are best for a motion that stops
STOPPED = "stopped early by the time limit: the best law found by then is used; give more with --time-limit"
SHOWN = 5  # passages, of which the terminal tells
NOTICEABLE = 1e-9  # relative; two baselines nearer than that are one


def describe_passing(design: Design, through: Through) -> list[str]:
    """Time against the laws that stop, what is passed, and how far the arcs are left."""
    found = [_describe_time(design), *_describe_effort(design, through), *_describe_passages(design, through)]
    spline = time_rotation_spline(design.optimised.law) if through.passed else None
    if spline is not None:
        ends = " and ".join(f"{np.degrees(speed):.3g}" for speed in spline.ends)
        found.append(
            f"SciPy's RotationSpline through the same nodes takes {spline.duration:.6g} s under the same "
            f"limits (sampled, not proved): its jerk jumps, and it moves at its ends, at {ends} deg/s."
        )
    if through.passed and design.problem.route.tour in COUNT_STOPS:
        found.append(
            f"The tour, {design.problem.route.tour}, counts stops that are not made: try shortest too."
        )
    farthest = find_farthest(design.optimised.law)
    if farthest is not None:
        asked = design.problem.motion.deviation
        allowed = "" if asked is None else f"; {np.degrees(asked):g}° are allowed"
        found.append(
            f"It leaves the arcs by {np.degrees(farthest.angle):.3g}° of body rotation at most, on leg "
            f"{farthest.segment} at t = {farthest.time:.4f} s{allowed}."
        )
    return found


def _describe_time(design: Design) -> str:
    law, route, requirements = design.optimised.law, design.route, design.requirements
    every, runs = (time_double_s(route, requirements, stop=stop).duration for stop in (True, False))
    quintic = time_quintic(requirements).duration
    parts = [f"{law.duration / every:.4f} of the double-S that stops at every node ({every:.6g} s)"]
    if abs(every / runs - 1) > NOTICEABLE:
        parts.append(f"{law.duration / runs:.4f} of the double-S that stops at corners only ({runs:.6g} s)")
    parts.append(f"{law.duration / quintic:.4f} of the paper's quintic ({quintic:.6g} s)")
    return f"The law takes {law.duration:.6g} s: {', '.join(parts)}."


def _describe_effort(design: Design, through: Through) -> list[str]:
    """What was made less, beside that of the law that stops."""
    if through.spent is None:
        return []
    objective = OBJECTIVES[design.problem.objective.minimise]
    unit = f" {objective.unit}" if objective.unit else ""
    found = f"Its {objective.symbol} is {through.spent:.5g}{unit}"
    if through.stopping_spent is None:
        return [f"{found}; no law that stops at corners keeps what is given."]
    part = 1 - through.spent / through.stopping_spent
    less = "less" if part >= 0 else "more"
    return [f"{found}, {abs(100 * part):.1f} % {less} than that of the law that stops at corners."]


def _describe_passages(design: Design, through: Through) -> list[str]:
    nodes = design.route.nodes
    between = sum(len(passage.legs) - 1 for passage in through.passages)
    if not between:
        return ["There is a stop at every node, so that there is none to be passed."]
    found = []
    if through.passed:
        found.append(f"It passes {through.passed} of {between} nodes without a stop.")
    slower = [passage for passage in through.passages if passage.curve is None and len(passage.legs) > 1]
    if slower:
        places = _name_places(slower, [node.label for node in nodes])
        found.append(
            f"Stopping at corners is faster {places}, or nothing else was found: there the law stops."
        )
    return found


def _name_places(passages: Sequence[Passage], labels: Sequence[str]) -> str:
    """Where some passages are; the whole way without names."""
    if len(passages) == 1 and passages[0].first == 0 and passages[0].last == len(labels) - 1:
        return "on the whole way"
    names = [f"from {labels[p.first]} to {labels[p.last]}" for p in passages]
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return ", ".join(names[:3]) + more


def describe_rungs(route: Route, through: Through) -> list[str]:
    """What each rung of the search came to, passage by passage of one time."""
    found = []
    for passage in through.passages:
        tried = [
            f"{rung.pieces} piece{'s' if rung.pieces > 1 else ''} of degree {rung.degree} a leg: "
            + (f"{rung.time:.6g} s in {rung.steps} steps" if rung.time else f"none in {rung.steps} steps")
            for rung in passage.rungs
        ]
        if tried:
            ends = f"{route.nodes[passage.first].label} to {route.nodes[passage.last].label}"
            found.append(f"{ends}: {'; '.join(tried)}")
    more = len(found) - SHOWN
    shown = [*found[:SHOWN], f"and {more} passages more"] if more > 0 else found
    return [*shown, STOPPED] if through.stopped_early else shown
