"""The errors a user can cause, each with its exit code; everything else is a defect of ours."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import islice

EXIT_DONE = 0
EXIT_FINDINGS = EXIT_DEFECT = 1  # Python's own for a traceback
EXIT_BAD_INPUT = 2
EXIT_INFEASIBLE = 3
EXIT_INTERRUPTED = 130
MOST_FAULTS = 100  # of a file that are listed; nobody corrects more before trying again
MOST_SHOWN = 500  # characters of what was given; a line of text on a screen or two, not the whole file


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong in an input, and where: `path:line:column: where: what`."""

    message: str
    where: str = ""
    path: str = ""
    line: int | None = None
    column: int | None = None

    def at(self, place: tuple[int, int] | None) -> "Fault":
        """The same fault at another line and column, if one is given."""
        return self if place is None else replace(self, line=place[0], column=place[1])

    def __str__(self) -> str:
        place = self.path
        if self.line is not None:
            place += f":{self.line}:{self.column}"
        return ": ".join(part for part in (place, self.where, self.message) if part)


def list_some(names: Sequence[str], most: int = 6) -> str:
    """The first names of a list, and how many there are."""
    shown = ", ".join(names[:most])
    return shown if len(names) <= most else f"{shown}, … ({len(names)} in all)"


def shorten(text: str, most: int = MOST_SHOWN) -> str:
    """A text that was given, as a message shows it: a long one by its start and its length."""
    return text if len(text) <= most else f"{text[:most]}… ({len(text)} characters)"


def list_first(faults: Iterable[Fault], count: int, path: str) -> list[Fault]:
    """The first of so many faults of a file, and how many more there are."""
    kept = list(islice(faults, MOST_FAULTS))
    more = count - len(kept)
    return [*kept, Fault(f"{more} more faults", "", path)] if more else kept


class TimelawError(Exception):
    """An error with a message for the user and an exit code for the shell."""

    exit_code = EXIT_BAD_INPUT

    def __init__(self, *faults: Fault | str) -> None:
        self.faults = tuple(f if isinstance(f, Fault) else Fault(f) for f in faults)
        super().__init__("\n".join(str(f) for f in self.faults))

    def __reduce__(self) -> tuple[type["TimelawError"], tuple[Fault, ...]]:
        """Sent from one process to another with all its faults."""
        return type(self), self.faults


class InputError(TimelawError):
    """The command line or a file is wrong."""


class InfeasibleError(TimelawError):
    """The problem is well-formed but has no solution, or none was found."""

    exit_code = EXIT_INFEASIBLE
