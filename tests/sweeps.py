"""Studies of many cheap designs, and what their log and table hold."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from timelaw.cli.app import run_command

CHEAP = """\
timelaw: 1
name: p
route: {tour: given, orientations: {list: [[1, 0, 0, 0], [0.8, 0.6, 0, 0], [0, 1, 0, 0]]}}
limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}
easing: {basis: double-s}
baselines: []
"""  # in closed form: some milliseconds each


def write_study(folder: Path, count: int, problem: str = CHEAP) -> Path:
    """A study of so many designs, an even number: velocity and acceleration are varied."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "p.yaml").write_text(problem)
    vary = (
        f"  limits.velocity: {{from: 20 deg/s, to: 80 deg/s, steps: {count // 2}}}\n"
        "  limits.acceleration: [90 deg/s^2, 150 deg/s^2]\n"
    )
    path = folder / "s.yaml"
    path.write_text(f"timelaw-study: 1\nname: s\nproblem: p.yaml\nvary:\n{vary}")
    return path


def sweep_here(study: Path, output: Path) -> bytes:
    """The table of a sweep in this process."""
    assert run_command(["sweep", str(study), "-o", str(output), "--processes", "1", "--quiet"]) == 0
    return (output / "sweep.csv").read_bytes()


def list_keys(log: Path) -> list[str]:
    """The keys in a log, in the order of its whole lines."""
    return [entry["key"] for entry in read_entries(log)]


def read_entries(log: Path) -> Iterator[dict[str, Any]]:
    """What each whole line after the first holds, read as any program would."""
    whole, _, _ = log.read_bytes().rpartition(b"\n")
    for line in whole.splitlines()[1:]:
        yield json.loads(line, parse_constant=refuse)


def refuse(word: str) -> None:
    """JSON knows no infinity."""
    raise ValueError(word)
