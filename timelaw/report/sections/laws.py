"""The optimised law beside the baselines."""

from math import inf, isfinite
from typing import Any

from timelaw.certificate.effort import measure_effort, measure_torque
from timelaw.least_time.constant_bounds import rate_bounds
from timelaw.least_time.phase_plane import has_coupling
from timelaw.least_time.snap import symmetric_time
from timelaw.objectives import EFFORTS, Objective
from timelaw.pipeline import Design
from timelaw.report.section import Facts, Section

JERK = 3  # the order whose effort the table has for every problem


def _context(facts: Facts) -> dict[str, Any]:
    design = facts.design
    given = design.requirements.arrivals or design.problem.objective.total_time is not None
    return {
        "rows": facts.rows,
        "limits": [check.limit for check in design.optimised.certificate.limits],
        "given_times": bool(given),
        "findings": [
            (entry.name, entry.certificate.limit_findings()[0])
            for entry in design.baselines
            if not entry.certificate.limits_hold
        ],
        "effort": _measure_objective(design),
        "symmetric": _time_symmetric(design),
        "unbounded": any(not isfinite(row.smoothness) for row in facts.rows),
    }


def _measure_objective(design: Design) -> tuple[Objective, list[float]] | None:
    """The effort that was made least, and its value for every law; None where the table has it already."""
    name = design.problem.objective.minimise
    if name not in EFFORTS or max(EFFORTS[name].orders) == JERK:
        return None
    effort = EFFORTS[name]
    if effort.needs_inertia:
        return effort, [
            measure_torque(entry.law) if entry.certificate.continuity.order >= 1 else inf
            for entry in design.laws
        ]
    order = max(effort.orders)
    return effort, [measure_effort(entry.law, entry.certificate.continuity, order) for entry in design.laws]


def _time_symmetric(design: Design) -> float | None:
    """What symmetric profiles under the snap limit too would take; None where there is none."""
    requirements = design.requirements
    total = requirements.dwell_time
    for run in requirements.by_run(design.route):
        bounds = [min(b) for b in zip(*(rate_bounds(leg.rows) for leg in run.demands), strict=True)]
        if bounds[-1] == inf or not run.elastic or has_coupling([r for leg in run.demands for r in leg.rows]):
            return None
        total += symmetric_time(sum(leg.angle for leg in run.demands), bounds)
    return total


SECTION = Section("Laws side by side", "laws.html", _context)
