"""What the commands print: one JSON object on stdout if asked, all human text on stderr."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from timelaw.cli.last_word import print_object
from timelaw.errors import TimelawError
from timelaw.interrupts import finish_work
from timelaw.progress import Progress
from timelaw.units import convert, name_unit

if TYPE_CHECKING:
    from timelaw.certificate import Certificate

RESULTS = Path("results")  # where results go, in a folder of their name
UNBOUNDED = 100_000  # characters; no table of ours is wider


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


@contextmanager
def show_progress() -> Iterator[Progress | None]:
    """Report (stage, done, of) on stderr, on a terminal only."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("reading", total=None)

        def report(stage: str, done: int, of: int) -> None:
            bar.update(task, description=stage, completed=done, total=of)

        yield report


def print_table(headings: list[str], rows: list[list[str]]) -> None:
    """A table on stderr: the first column to the left, numbers to the right."""
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), collapse_padding=True)
    for index, heading in enumerate(headings):
        table.add_column(Text(heading), justify="right" if index else "left", no_wrap=True)
    for row in rows:
        table.add_row(*map(Text, row))  # labels may hold what markup looks like
    # as wide as it is: a terminal folds what is too long for it, and nothing is cut
    console = Console(stderr=True, highlight=False)
    widest = console.measure(table, options=console.options.update(max_width=UNBOUNDED)).maximum
    Console(stderr=True, highlight=False, width=max(widest, console.width), height=console.height).print(
        table
    )


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
    """A line on stderr."""
    print(text, file=sys.stderr)
