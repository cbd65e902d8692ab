"""The numbers of the comparison: one row per law, one per distinct run."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf, isfinite
from typing import Any

import numpy as np

from timelaw.certificate.effort import measure_effort, measure_torque
from timelaw.limits import Demand
from timelaw.nlp import Solution
from timelaw.objectives import EFFORTS
from timelaw.pipeline import Certified, Design
from timelaw.requirements.run_demand import RunDemand
from timelaw.time_law.baselines import QUINTIC, time_quintic


@dataclass(frozen=True)
class LawRow:
    """One law beside the others: times in s, `peaks` as proved peak over limit.

    `to_limit` is infinite where no bound on the time is known, `smoothness` = ∫|jerk|² dt where ω or α
    jumps. A law `holds` if its limits do and it is as smooth as was asked of it.
    """

    name: str
    duration: float
    to_quintic: float
    to_limit: float
    peaks: dict[str, float]
    continuity: int
    smoothness: float
    holds: bool
    limits_hold: bool

    def to_dict(self) -> dict[str, Any]:
        """As `--json` prints it: null for what has no bound."""
        unbounded = {name: None for name in ("smoothness", "to_limit") if not isfinite(self.__dict__[name])}
        return {**self.__dict__, **unbounded}


@dataclass(frozen=True)
class RunRow:
    """How one distinct run was solved."""

    count: int
    angles: tuple[float, ...]
    duration: float
    to_limit: float
    status: str
    rounds: int
    iterations: int
    rows: int
    gap: float


def list_law_rows(design: Design) -> list[LawRow]:
    """The optimised law first, then the baselines."""
    slowest = _time_slowest(design)
    return [_row(entry, slowest, design.limit) for entry in design.laws]


def _time_slowest(design: Design) -> float:
    """The quintic's time, as the baselines have it, or the least if it is none of them."""
    known = next((b.law.duration for b in design.baselines if b.name == QUINTIC), None)
    return time_quintic(design.requirements).duration if known is None else known


def _row(entry: Certified, slowest: float, least: float) -> LawRow:
    certificate = entry.certificate
    return LawRow(
        entry.name,
        certificate.duration,
        certificate.duration / slowest,
        _exceed(certificate.duration, least),
        {check.limit: check.ratio for check in certificate.limits},
        certificate.continuity.order,
        measure_effort(entry.law, certificate.continuity, 3),
        certificate.holds,
        certificate.limits_hold,
    )


def _exceed(duration: float, least: float) -> float:
    return duration / least if least else inf


def list_run_rows(design: Design) -> list[RunRow]:
    """The distinct runs, in the order in which the route meets them; or all of them as one, if solved so."""
    runs = design.requirements.by_run(design.route)
    if len(design.solution.solutions[0].timings) == len(design.route.legs):
        least = sum(run.limit for run in runs)
        return [_run_row(1, design.requirements.demands, least, design.solution.solutions[0])]
    alike: dict[int, list[RunDemand]] = defaultdict(list)
    for run, index in zip(runs, design.solution.of_run, strict=True):
        alike[index].append(run)
    return [
        _run_row(len(own), own[0].demands, own[0].limit, design.solution.solutions[index])
        for index, own in sorted(alike.items())
    ]


def join_alike(runs: Sequence[RunRow]) -> list[RunRow]:
    """Rows that a table shows alike as one, with the most rounds, iterations and rows of any of them."""
    groups: dict[Any, list[RunRow]] = defaultdict(list)
    for run in runs:
        angles = tuple(f"{np.degrees(angle):.6g}" for angle in run.angles)
        groups[angles, f"{run.duration:.5f}", run.status].append(run)
    return [
        replace(
            alike[0],
            count=sum(run.count for run in alike),
            rounds=max(run.rounds for run in alike),
            iterations=max(run.iterations for run in alike),
            rows=max(run.rows for run in alike),
            gap=max(run.gap for run in alike),
        )
        for alike in groups.values()
    ]


def _run_row(count: int, demands: Sequence[Demand], least: float, solution: Solution) -> RunRow:
    return RunRow(
        count,
        tuple(demand.angle for demand in demands),
        solution.duration,
        _exceed(solution.duration, least),
        solution.describe(),
        solution.rounds,
        solution.iterations,
        solution.rows,
        max(solution.gap, 0.0),
    )


def _measure_curves(design: Design) -> dict[str, float]:
    """The same of a law that leaves the arcs."""
    law, continuity = design.optimised.law, design.optimised.certificate.continuity
    orders = {name: max(effort.orders) for name, effort in EFFORTS.items() if not effort.needs_inertia}
    found = {name: measure_effort(law, continuity, order) for name, order in orders.items()}
    if law.body is not None and not law.body.total_momentum:
        found["torque"] = measure_torque(law) if continuity.order >= 1 else inf
    return dict(sorted(found.items()))


def measure_all_efforts(design: Design) -> dict[str, float]:
    """∫ of each effort over the optimised law, infinite where a rate below it jumps.

    Those that need the inertia only where it is known.
    """
    if design.through is not None:
        return _measure_curves(design)
    demands, timings = design.requirements.demands, design.solution.timings
    known = all(demand.torque is not None for demand in demands)
    smooth = design.optimised.certificate.continuity.order
    return {
        name: EFFORTS[name].measure(demands, timings) if EFFORTS[name].continuity <= smooth else inf
        for name in sorted(EFFORTS)
        if known or not EFFORTS[name].needs_inertia
    }
