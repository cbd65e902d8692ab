"""The command line: `timelaw design`, `verify`, `tour` and `sweep`."""

from timelaw.cli.app import main

__all__ = ["main"]
