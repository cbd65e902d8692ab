"""The command line: `timelaw design`, `verify`, `tour` and `sweep`."""

from timelaw.cli.entry import main

__all__ = ["main"]
