"""What came of one point of a study, as a row of its table and as a line of its log."""

from dataclasses import dataclass, field, replace
from functools import cache
from math import inf, isfinite
from pathlib import Path
from typing import Any, Literal

from pydantic import TypeAdapter

from timelaw.errors import InfeasibleError, TimelawError
from timelaw.pipeline import Design
from timelaw.report import list_law_rows
from timelaw.report.passing_text import describe_rungs
from timelaw.report.summary import measure_all_efforts

Failure = Literal["", "infeasible", "wrong"]
UNBOUNDED = ("efforts", "peaks")  # fields of numbers, null in JSON where they have no bound


@dataclass(frozen=True)
class Outcome:
    """What came of one point: its numbers, or why there are none.

    A `failure` is `infeasible` where no law was found, `wrong` where the point makes no problem.
    """

    point: dict[str, Any]
    holds: bool = False
    duration: float | None = None
    to_limit: float | None = None
    continuity: int | None = None
    efforts: dict[str, float] = field(default_factory=dict)
    peaks: dict[str, float] = field(default_factory=dict)
    easing: str = ""
    status: str = ""
    failure: Failure = ""

    def to_dict(self) -> dict[str, Any]:
        """As `--json` prints it and the log holds it: null for what has no bound."""
        bounded = {
            name: {key: value if isfinite(value) else None for key, value in self.__dict__[name].items()}
            for name in UNBOUNDED
        }
        return {**self.__dict__, **bounded}


def parse_outcome(data: dict[str, Any]) -> Outcome:
    """The outcome of which `to_dict` made this.

    Raises:
        ValueError: it is none.
    """
    found = dict(data)
    for name in UNBOUNDED:
        numbers = data.get(name)
        if isinstance(numbers, dict):
            found[name] = {key: inf if value is None else value for key, value in numbers.items()}
    return _adapter().validate_python(found)


@cache
def _adapter() -> TypeAdapter[Outcome]:
    return TypeAdapter(Outcome)


def describe_failure(point: dict[str, Any], error: TimelawError, problem: str) -> Outcome:
    """The outcome of a point that has no law; places in the file `problem` are not told, nor folders."""
    if isinstance(error, InfeasibleError):
        return Outcome(point, status="; ".join(f.message for f in error.faults), failure="infeasible")
    faults = (
        replace(fault, path="", line=None)
        if fault.path == problem
        else replace(fault, path=Path(fault.path).name)
        for fault in error.faults
    )
    return Outcome(point, status="; ".join(map(str, faults)), failure="wrong")


def summarise_design(point: dict[str, Any], design: Design) -> Outcome:
    """The outcome of a point that has a law."""
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
