"""From what the problem file says to an order of visits, and how good that order is."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from timelaw.errors import Fault, InputError, some
from timelaw.numerics.quaternion import angle_between
from timelaw.orientations import OrientationSet
from timelaw.problem.route import RouteModel
from timelaw.tours.distance import NEIGHBOUR_TOLERANCE, distances, minimal_distance
from timelaw.tours.fewest_stops import fewest_stops
from timelaw.tours.lines import Lines
from timelaw.tours.shortest import shortest

Order = tuple[int, ...]

PAPER_TOUR = (1, 12, 11, 3, 8, 10, 2, 7, 9, 6, 5, 4)


@dataclass(frozen=True)
class Tour:
    """Indices of the orientations in the order of visits, all N of them, each once.

    A closed tour goes back to its first orientation; the return leg is not repeated in `order`.
    `length` is the sum of the body's rotation angles [rad], `minimal` the least angle between any
    two orientations: `length` = legs × `minimal` proves that no tour is shorter.
    """

    order: Order
    closed: bool
    length: float
    minimal: float

    @property
    def legs(self) -> int:
        """Number of legs."""
        return len(self.order) - 1 + self.closed

    @property
    def is_shortest(self) -> bool:
        """Whether every leg has the minimal distance, which proves the tour shortest."""
        return self.length <= self.legs * (self.minimal + NEIGHBOUR_TOLERANCE)

    def stops(self) -> Order:
        """Indices with the first one repeated at the end of a closed tour."""
        return self.order + self.order[:1] if self.closed else self.order


def tour(spec: RouteModel, points: OrientationSet) -> Tour:
    """The order of visits that the problem asks for.

    Raises:
        InputError: an unknown label, a repeated or missing one, or a tour the set does not have.
    """
    order = (
        _by_labels(spec.tour, points)
        if isinstance(spec.tour, tuple)
        else TOURS[spec.tour](points, spec.closed)
    )
    visits = points.quaternions[list(order + order[:1] if spec.closed else order)]
    length = float(np.sum(angle_between(visits[:-1], visits[1:])))
    return Tour(order, spec.closed, length, minimal_distance(points.quaternions))


def _given(points: OrientationSet, _closed: bool) -> Order:
    """The order in which the orientations are listed."""
    return tuple(range(len(points)))


def _paper(points: OrientationSet, _closed: bool) -> Order:
    """The tour printed in [MMB2017] for the 24-cell."""
    if points.lattice != "24-cell":
        raise _fault(
            f'"paper" is the tour of the lattice 24-cell, not of {points.source}; '
            "use given, shortest or a list of labels"
        )
    return tuple(i - 1 for i in PAPER_TOUR)


def _shortest(points: OrientationSet, closed: bool) -> Order:
    """A Hamiltonian path or cycle whose legs all have the minimal distance."""
    if points.lattice is None:
        raise _fault('"shortest" is there for the lattices; use given or a list of labels')
    return shortest(distances(points.quaternions), closed=closed)


def _fewest_stops(points: OrientationSet, closed: bool) -> Order:
    """Of the shortest tours one that goes straight on at the most nodes known."""
    if points.lattice is None:
        raise _fault('"fewest-stops" is there for the lattices; use given or a list of labels')
    return fewest_stops(points.lattice, Lines(points.quaternions), closed=closed)


TOURS: dict[str, Callable[[OrientationSet, bool], Order]] = {
    "given": _given,
    "paper": _paper,
    "shortest": _shortest,
    "fewest-stops": _fewest_stops,
}


def _by_labels(labels: tuple[str, ...], points: OrientationSet) -> Order:
    index = {label: i for i, label in enumerate(points.labels)}
    unknown = [label for label in labels if label not in index]
    if unknown:
        raise _fault(f'no orientation is called "{unknown[0]}"; there are {some(points.labels)}')
    repeated = [label for i, label in enumerate(labels) if label in labels[:i]]
    if repeated:
        raise _fault(
            f'the tour visits "{repeated[0]}" more than once; set closed: true to return to the start'
        )
    missing = [label for label in points.labels if label not in labels]
    if missing:
        raise _fault(f"the tour leaves out {some(missing)}; every orientation must be visited")
    return tuple(index[label] for label in labels)


def _fault(message: str) -> InputError:
    return InputError(Fault(message, "route.tour"))
