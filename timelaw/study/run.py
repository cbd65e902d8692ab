"""Run a study: every point a design of its own, on the processes of this machine."""

import os
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

from timelaw.errors import InputError, TimelawError
from timelaw.pipeline import Design, design_problem
from timelaw.problem.load import check_problem
from timelaw.progress import Progress
from timelaw.report import list_law_rows
from timelaw.report.passing_text import describe_rungs
from timelaw.report.summary import measure_all_efforts
from timelaw.study.study import Study
from timelaw.workers import run_tasks


@dataclass(frozen=True)
class Outcome:
    """What came of one point: its numbers, or why there are none."""

    point: dict[str, Any]
    holds: bool = False
    duration: float | None = None
    to_limit: float | None = None
    continuity: int | None = None
    efforts: dict[str, float] = field(default_factory=dict)
    peaks: dict[str, float] = field(default_factory=dict)
    easing: str = ""
    status: str = ""

    def to_dict(self) -> dict[str, Any]:
        """As `--json` prints it: null for an effort that has no bound."""
        efforts = {name: value if isfinite(value) else None for name, value in self.efforts.items()}
        return {**self.__dict__, "efforts": efforts}


def run_study(study: Study, processes: int | None = None, progress: Progress | None = None) -> list[Outcome]:
    """Design every point, in as many processes as there are processors unless told otherwise.

    A point that cannot be met is an outcome that says so; a point that makes no sense as a
    problem file ends the study.

    Raises:
        InputError: a varied key or value is not one a problem file may have.
    """
    points = list(study.points())
    for point in points:
        _check(study, point)
    workers = min(processes or os.cpu_count() or 1, len(points))
    if workers == 1:
        outcomes = []
        for done, point in enumerate(points):
            if progress is not None:
                progress("designing", done, len(points))
            outcomes.append(run_point(study, point))
        return outcomes
    found: dict[int, Outcome] = {}
    for index, outcome in run_tasks(run_point, [(study, point) for point in points], workers):
        found[index] = outcome
        if progress is not None:
            progress("designing", len(found), len(points))
    return [found[index] for index in range(len(points))]


def _check(study: Study, point: dict[str, Any]) -> None:
    """Whether a point makes a problem file; what is wrong is told at the study's key."""
    try:
        check_problem(study.base.with_values(point))
    except InputError as error:
        values = ", ".join(f"{key} = {value}" for key, value in point.items())
        faults = [f"with {values}: {fault.where}: {fault.message}" for fault in error.faults]
        raise InputError(*(study.source.fault(("vary",), text) for text in faults)) from None


def run_point(study: Study, point: dict[str, Any]) -> Outcome:
    """Design one point."""
    source = study.base.with_values(point)
    try:
        return _outcome(point, design_problem(study.path, check_problem(source), source))
    except InputError:
        raise
    except TimelawError as error:
        return Outcome(point, status="; ".join(fault.message for fault in error.faults))


def _outcome(point: dict[str, Any], design: Design) -> Outcome:
    row = list_law_rows(design)[0]
    status = sorted({s.describe() for s in design.solution.solutions})
    if design.through is not None:
        status = describe_rungs(design.route, design.through)
    return Outcome(
        point,
        row.holds,
        row.duration,
        row.to_limit if isfinite(row.to_limit) else None,
        row.continuity,
        measure_all_efforts(design),
        row.peaks,
        design.family.label,
        "; ".join(status if row.holds else design.optimised.certificate.findings()),
    )
