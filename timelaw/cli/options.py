"""Options that several commands share."""

from collections.abc import Callable
from math import isnan
from typing import Any

import click

from timelaw.cli.console import set_speech


def refuse_nan(_context: click.Context, parameter: click.Parameter, value: float | None) -> float | None:
    """Which no range keeps out."""
    if value is not None and isnan(value):
        raise click.BadParameter("nan is not a number", param=parameter)
    return value


def take_number(name: str, least: float, most: float, **settings: Any) -> Callable[..., Any]:
    """An option that is a number within bounds."""
    return click.option(name, type=click.FloatRange(least, most), callback=refuse_nan, **settings)


def speaking(command: Callable[..., int]) -> Callable[..., int]:
    """Options of every command: how much is said, and to whom."""
    options = (
        click.option(
            "--no-progress",
            is_flag=True,
            expose_value=False,
            callback=lambda _context, _parameter, value: set_speech(progress=not value),
            help="Show no progress on a terminal.",
        ),
        click.option(
            "--quiet",
            is_flag=True,
            expose_value=False,
            callback=lambda _context, _parameter, value: set_speech(quiet=value),
            help="Say nothing but findings and errors.",
        ),
        click.option("--json", "as_json", is_flag=True, help="Print one JSON object on stdout."),
    )
    for option in reversed(options):
        command = option(command)
    return command
