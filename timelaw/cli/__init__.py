"""The command line: `timelaw design`, `verify`, `tour`, `sweep` and `compare`."""

from timelaw.cli.entry import main

__all__ = ["main"]
