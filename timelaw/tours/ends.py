"""Where a tour begins and ends: what is asked of every search."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

Visit = TypeVar("Visit")


@dataclass(frozen=True)
class Ends:
    """A closed tour or an open one; indices of its first and last node, where they are given."""

    closed: bool = False
    start: int | None = None
    end: int | None = None

    def admits(self, order: tuple[int, ...]) -> bool:
        """Whether an order of visits begins and ends where it should."""
        return self.start in (None, order[0]) and self.end in (None, order[-1])


def list_visits(order: Sequence[Visit], *, closed: bool) -> tuple[Visit, ...]:
    """The visits of a tour, the first one again at the end of a closed one."""
    return (*order, order[0]) if closed else tuple(order)
