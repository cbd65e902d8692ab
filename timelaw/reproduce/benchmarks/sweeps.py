"""The part `sweep`: designs a second of a study, beside the same designs one after the other."""

import json
import time
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from timelaw.pipeline import design_problem
from timelaw.problem.load import check_problem
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.problems import LIMITS, POLYNOMIAL, make_lattice_data
from timelaw.reproduce.benchmarks.stopwatch import run_python
from timelaw.reproduce.benchmarks.table import Table, format_number
from timelaw.study import read_study

HEADINGS = (
    "way",
    "designs",
    "CPU [s]",
    "designs a second of CPU",
    "to the loop",
    "real time [s]",
    "designs a second",
)
POINTS = {True: 6, False: 60}  # by quick
PROCESSES = (1, 2)
NOTES = (
    "The paper's tour at degree 9, the limit of the jerk varied. **Loop**: `design_problem` for one after "
    "the other, in this process. **Sweep**: `timelaw sweep` as a command, with start-up, its table and "
    "picture; CPU of all its processes.",
)


def measure(*, quick: bool) -> Table:
    """The loop, then the command on one process and on two."""
    count = POINTS[quick]
    with TemporaryDirectory() as name:
        folder = Path(name)
        write_study(folder, count)
        began, begun = time.perf_counter(), time.process_time()
        design_points(folder / "study.yaml")
        loop = time.process_time() - begun
        rows = [_tell("loop", count, loop, time.perf_counter() - began, loop)]
        for processes in PROCESSES:
            command = [
                "-m",
                "timelaw",
                "sweep",
                "study.yaml",
                "-o",
                f"out-{processes}",
                "--processes",
                f"{processes}",
            ]
            spent = run_python(command, folder)
            label = "sweep, one process" if processes == 1 else f"sweep, {processes} processes"
            rows.append(_tell(label, count, spent.cpu, spent.real, loop))
    return Table(HEADINGS, tuple(rows), NOTES)


def write_study(folder: Path, count: int) -> None:
    """A problem file and a study of it, JSON as YAML has it too."""
    jerk = LIMITS["jerk"]
    varied = {"limits.jerk": {"from": f"{jerk / 2} deg/s^3", "to": f"{2 * jerk} deg/s^3", "steps": count}}
    study: dict[str, Any] = {
        "timelaw-study": 1,
        "name": "measured",
        "problem": "problem.yaml",
        "vary": varied,
    }
    data = make_lattice_data(11, easing=POLYNOMIAL)
    (folder / "problem.yaml").write_text(json.dumps(data), encoding="utf-8")
    (folder / "study.yaml").write_text(json.dumps(study), encoding="utf-8")


def design_points(path: Path) -> int:
    """Design every point of a study; returns how many there are."""
    study = read_study(path)
    for point in study.points():
        source = study.base.with_values(point)
        design_problem(study.path, check_problem(source), source)
    return study.size


def _tell(way: str, count: int, cpu: float, real: float, loop: float) -> tuple[str, ...]:
    rates = format_number(count / cpu), format_number(cpu / loop)
    return way, str(count), format_number(cpu), *rates, format_number(real), format_number(count / real)


PART = Part("sweep", HEADINGS, measure)
