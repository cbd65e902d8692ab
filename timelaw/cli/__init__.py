"""The command line: `timelaw design`, `timelaw verify`."""

from timelaw.cli.main import main

__all__ = ["main"]
