"""Where a tour begins and ends: what is asked of every search."""

from dataclasses import dataclass

from timelaw.errors import Fault, InputError, list_some
from timelaw.orientations import OrientationSet
from timelaw.problem.route import RouteModel


@dataclass(frozen=True)
class Ends:
    """A closed tour or an open one; indices of its first and last node, where they are given."""

    closed: bool = False
    start: int | None = None
    end: int | None = None

    def admits(self, order: tuple[int, ...]) -> bool:
        """Whether an order of visits begins and ends where it should."""
        return self.start in (None, order[0]) and self.end in (None, order[-1])


def ends(spec: RouteModel, points: OrientationSet) -> Ends:
    """The ends a problem asks for, as indices.

    Raises:
        InputError: a label that no orientation has.
    """
    found: dict[str, int | None] = {}
    for key, label in (("start", spec.start), ("end", spec.end)):
        if label is not None and label not in points.labels:
            message = f'no orientation is called "{label}"; there are {list_some(points.labels)}'
            raise InputError(Fault(message, f"route.{key}"))
        found[key] = None if label is None else points.labels.index(label)
    return Ends(spec.closed, found["start"], found["end"])
