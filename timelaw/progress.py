"""How long work says how far it is: a function of (stage, done, of how many), and a count of steps."""

from collections.abc import Callable
from dataclasses import dataclass

Progress = Callable[[str, int, int], None]


@dataclass
class _Steps:
    """Iterations of nonlinear programs and cone programs, since the process began."""

    taken: int = 0


_steps = _Steps()


def tell(progress: Progress | None, stage: str, done: int = 0, of: int = 1) -> None:
    """Say it to whoever listens, if anybody does."""
    if progress is not None:
        progress(stage, done, of)


def count_steps(number: int = 1) -> None:
    """A solver has taken so many more steps."""
    _steps.taken += number


def read_steps() -> int:
    """How many steps solvers have taken in this process."""
    return _steps.taken
