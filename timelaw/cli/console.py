"""What the commands print: one JSON object on stdout if asked, all human text on stderr."""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from timelaw.cli.last_word import print_object
from timelaw.cli.table import format_table
from timelaw.errors import TimelawError
from timelaw.interrupts import finish_work
from timelaw.progress import Progress, read_steps
from timelaw.units import convert, name_unit

if TYPE_CHECKING:
    from timelaw.certificate import Certificate

RESULTS = Path("results")  # where results go, in a folder of their name
MEASURED = 600.0  # seconds of the past, from which the time left is told


def print_json(data: dict[str, Any]) -> None:
    """The object of finished work on stdout, whole even if a signal comes now.

    Raises:
        Interrupted: one came before.
    """
    with finish_work():
        print_object(data)


def describe_error(error: TimelawError, code: int) -> dict[str, Any]:
    """What `--json` prints of an error."""
    faults = [
        {"message": f.message, "where": f.where, "path": f.path, "line": f.line, "column": f.column}
        for f in error.faults
    ]
    return {"ok": False, "exit_code": code, "errors": faults}


@dataclass
class _Speech:
    """How much is said to people: `quiet` for findings and errors alone, `progress` while work goes on."""

    quiet: bool = False
    progress: bool = True


_speech = _Speech()


def set_speech(*, quiet: bool | None = None, progress: bool | None = None) -> None:
    """For the command that runs; what is not given stays."""
    _speech.quiet = _speech.quiet if quiet is None else quiet
    _speech.progress = _speech.progress if progress is None else progress


@contextmanager
def show_progress(*, time_left: bool = False) -> Iterator[Progress | None]:
    """Report (stage, done, of) on stderr, on a terminal only; time and steps go on by themselves.

    `time_left` is for many steps that take about the same time each.
    """
    if _speech.quiet or not _speech.progress or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        *((TextColumn("left"), TimeRemainingColumn()) if time_left else (_make_steps_column(),)),
    )
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, speed_estimate_period=MEASURED) as bar:
        task = bar.add_task("reading", total=None)

        def report(stage: str, done: int, of: int) -> None:
            new = bar.tasks[0].description != stage  # is shown at once, however short it is
            bar.update(task, description=stage, completed=done, total=of, refresh=new)

        yield report


def _make_steps_column() -> Any:
    """How many steps the solvers have taken, since progress is shown."""
    from rich.progress import ProgressColumn
    from rich.text import Text

    class Steps(ProgressColumn):
        before = read_steps()

        def render(self, task: Any) -> Text:  # noqa: ARG002
            taken = read_steps() - self.before
            return Text(f"{taken} solver steps" if taken else "")

    return Steps()


def print_table(headings: list[str], rows: list[list[str]]) -> None:
    """A table on stderr: the first column to the left, numbers to the right."""
    say(format_table(headings, rows))


def print_limits(certificate: "Certificate", *, degrees: bool = False) -> None:
    """The proved peaks of a law against its limits, on stderr, angles in degrees or radians."""
    print_table(
        ["limit", "unit", "bound", "proved peak", "at t [s]", "on leg", "margin", "holds"],
        [
            [
                c.limit,
                name_unit(c.unit, degrees=degrees),
                f"{convert(c.bound, c.unit, degrees=degrees):.6g}",
                f"{convert(c.upper, c.unit, degrees=degrees):.6g}",
                f"{c.time:.4f}",
                c.segment,
                f"{c.margin:.1e}",
                "yes" if c.holds else "NO",
            ]
            for c in certificate.limits
        ],
    )


def say(text: str) -> None:
    """A line on stderr, unless only findings are wanted."""
    if not _speech.quiet:
        print(text, file=sys.stderr)


def say_findings(findings: Iterable[str]) -> None:
    """What is wrong with a law, a line on stderr each, however little is to be said."""
    for finding in findings:
        print(f"finding: {finding}", file=sys.stderr)
