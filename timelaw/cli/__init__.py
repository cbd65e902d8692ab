"""The command line: `timelaw design`, `timelaw verify`."""

from timelaw.cli.app import main

__all__ = ["main"]
