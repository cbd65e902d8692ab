"""`timelaw new`: a commented problem file to begin with; it asks on a terminal only, overwrites nothing."""

import sys
from importlib.resources import files
from pathlib import Path

import click

from timelaw.cli.console import say
from timelaw.errors import EXIT_DONE, Fault, InputError
from timelaw.files import write_files

KINDS = ("lattice", "table", "list")
TABLE = "{table}"  # where a template names its table


def run(kind: str | None, output: str | None) -> int:
    """Write a problem file of one of `KINDS`; returns the exit code."""
    if kind is None:
        kind = _ask_kind()
    path = Path(output if output is not None else f"{kind}.yaml")
    contents = make_files(kind, path)
    for there in contents:
        if there.exists():
            raise InputError(Fault("is there already; choose another name with -o", "", str(there)))
    write_files(contents)
    names = " and ".join(str(name) for name in contents)
    say(f"{names}: change what you like, then: timelaw design {path}")
    return EXIT_DONE


def make_files(kind: str, path: Path) -> dict[Path, str]:
    """The problem file, and the table that one of that kind reads."""
    templates = files("timelaw.cli") / "templates"
    text = (templates / f"{kind}.yaml").read_text(encoding="utf-8")
    if TABLE not in text:
        return {path: text}
    table = path.with_suffix(".csv")
    rows = (templates / f"{kind}.csv").read_text(encoding="utf-8")
    return {path: text.replace(TABLE, table.name), table: rows}


def _ask_kind() -> str:
    """On a terminal; elsewhere nobody answers, and the first kind is taken."""
    if not (sys.stdin.isatty() and sys.stderr.isatty()):
        return KINDS[0]
    return str(click.prompt("Orientations from a", type=click.Choice(KINDS), default=KINDS[0], err=True))
