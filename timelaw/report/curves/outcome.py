"""What came of a design along curves, in sentences, and its laws side by side."""

from dataclasses import dataclass
from typing import Any

from timelaw.pipeline import Certified
from timelaw.pipeline_bezier import BezierDesign
from timelaw.report.headline import Tile, show_difference, show_motion_time
from timelaw.report.numbers import write_number
from timelaw.report.problem_text import CONTINUOUS


@dataclass(frozen=True)
class CurveLawRow:
    """One law beside the others: times in s, `peaks` as proved peak over limit, by limit."""

    name: str
    duration: float
    to_quintic: float | None
    peaks: dict[str, float]
    continuity: int
    limits_hold: bool

    def to_dict(self) -> dict[str, Any]:
        """As `--json` prints it."""
        return dict(self.__dict__)


def list_curve_rows(design: BezierDesign) -> list[CurveLawRow]:
    """The optimised law first."""
    slowest = design.baselines[0].law.duration if design.baselines else None
    return [_row(entry, slowest) for entry in design.laws]


def _row(entry: Certified, slowest: float | None) -> CurveLawRow:
    certificate = entry.certificate
    return CurveLawRow(
        entry.name,
        certificate.duration,
        certificate.duration / slowest if slowest else None,
        {check.limit: check.ratio for check in certificate.limits},
        certificate.order,
        certificate.limits_hold,
    )


def describe_curves(design: BezierDesign) -> str:
    """The law's time against the quintic's."""
    row = list_curve_rows(design)[0]
    if row.to_quintic is None:
        return f"The optimised law takes {row.duration:.6g} s."
    less = "less" if row.to_quintic <= 1 else "more"
    change = f"{abs(100 * (1 - row.to_quintic)):.1f} % {less} than quintics with a stop at every joint"
    return f"The optimised law takes {row.duration:.6g} s, {change}."


def list_curve_tiles(design: BezierDesign) -> list[Tile]:
    """The gain in time, the time, and how smooth the motion is."""
    row, law = list_curve_rows(design)[0], design.optimised.law
    tiles = []
    if row.to_quintic is not None:
        tiles.append(show_difference(row.to_quintic, "time against quintics with a stop at every joint"))
    tiles += [Tile(f"{write_number(row.duration)} s", "total time"), *show_motion_time(law)]
    return [*tiles, Tile(f"C{row.continuity}", f"{CONTINUOUS[row.continuity]} without jumps")]


def describe_search(design: BezierDesign) -> list[str]:
    """How each run was searched."""
    return [
        f"{' and '.join(run.legs)}: {'stopped by the time limit after' if run.found.stopped else ''} "
        f"{run.found.steps} cone programs of at most {run.found.rows} rows, from {run.found.begun:.6g} s to "
        f"{run.duration:.6g} s; the proof added {run.gap:.1e} of it".replace(":  ", ": ")
        for run in design.runs
    ]
