"""The numbers of the comparison: one row per law, one per distinct run."""

from dataclasses import dataclass
from typing import Any

from timelaw.pipeline import Certified, Design
from timelaw.time_law import physical_limit, quintic
from timelaw.time_law.baselines import run_limit


@dataclass(frozen=True)
class LawRow:
    """One law beside the others: times in s, `peaks` as proved peak over limit."""

    name: str
    duration: float
    to_quintic: float
    to_limit: float
    peaks: dict[str, float]
    continuity: int
    smoothness: float
    holds: bool

    def to_dict(self) -> dict[str, Any]:
        """As `--json` prints it."""
        return dict(self.__dict__)


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


def law_rows(design: Design) -> list[LawRow]:
    """The optimised law first, then the baselines."""
    slowest = quintic(design.route, design.limits).duration
    least = physical_limit(design.route, design.limits)
    return [_row(entry, slowest, least) for entry in design.laws]


def _row(entry: Certified, slowest: float, least: float) -> LawRow:
    certificate = entry.certificate
    return LawRow(
        entry.name,
        certificate.duration,
        certificate.duration / slowest,
        certificate.duration / least,
        {check.limit: check.ratio for check in certificate.limits},
        certificate.continuity.order,
        entry.law.effort(3),
        certificate.holds,
    )


def run_rows(design: Design) -> list[RunRow]:
    """The distinct runs, in the order in which the route meets them."""
    rows = []
    for index, solution in enumerate(design.solution.solutions):
        runs = [r for r, i in zip(design.route.runs, design.solution.of_run, strict=True) if i == index]
        rows.append(
            RunRow(
                len(runs),
                runs[0].angles,
                solution.duration,
                solution.duration / run_limit(sum(runs[0].angles), design.limits),
                solution.status.value,
                solution.rounds,
                solution.iterations,
                solution.rows,
                solution.gap,
            )
        )
    return rows
