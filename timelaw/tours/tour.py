"""From what the problem file says to an order of visits, and how good that order is."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from timelaw.errors import Fault, InputError, list_some
from timelaw.numerics.quaternion import angle_between
from timelaw.orientations import OrientationSet
from timelaw.problem import Problem
from timelaw.problem.route import SEARCHED, RouteModel
from timelaw.progress import Progress
from timelaw.tours.ends import Ends, list_visits
from timelaw.tours.fastest import find_fastest
from timelaw.tours.graph.distances import (
    NEIGHBOUR_TOLERANCE,
    find_minimal_distance,
    list_neighbours,
    measure_costs,
)
from timelaw.tours.graph.minimal_legs import MinimalLegs
from timelaw.tours.merit import LENGTH, Merit, Searched
from timelaw.tours.shortest import MINIMAL, bound_length, find_shortest
from timelaw.tours.straightest import STRAIGHT, TURNING, find_straightest
from timelaw.tours.travel_rules import make_travel_times

Order = tuple[int, ...]
MOST_ORIENTATIONS = 10_000  # what a tour is searched for: half a minute
PAPER_TOUR = (1, 12, 11, 3, 8, 10, 2, 7, 9, 6, 5, 4)


@dataclass(frozen=True)
class Tour:
    """Indices of the orientations in the order of visits, all N of them, each once unless listed otherwise.

    A closed tour goes back to its first orientation; the return leg is not repeated in `order`.
    `length` is the sum of the body's rotation angles [rad], `minimal` the least angle between any
    two orientations: `length` = legs × `minimal` proves that no tour is shorter. `merits` say what
    is proved of it.
    """

    order: Order
    closed: bool
    length: float
    minimal: float
    merits: tuple[Merit, ...]

    @property
    def legs(self) -> int:
        """Number of legs."""
        return len(self.order) - 1 + self.closed

    @property
    def is_shortest(self) -> bool:
        """Whether it is proved that no tour with these ends is shorter."""
        return next(merit for merit in self.merits if merit.name == LENGTH).is_best

    def visits(self) -> Order:
        """Indices with the first one repeated at the end of a closed tour."""
        return list_visits(self.order, closed=self.closed)


@dataclass(frozen=True)
class Wanted:
    """What a search is given: the problem, the set, the ends of the tour."""

    problem: Problem
    points: OrientationSet
    ends: Ends
    progress: Progress | None = None


def find_tour(problem: Problem, points: OrientationSet, progress: Progress | None = None) -> Tour:
    """The order of visits that the problem asks for.

    Raises:
        InputError: an unknown label, a repeated or missing one, or a tour the set does not have.
    """
    spec = problem.route
    wanted = Wanted(problem, points, read_ends(spec, points), progress)
    if isinstance(spec.tour, tuple):
        searched = Searched(_by_labels(spec.tour, points, closed=spec.closed))
    else:
        if spec.tour in SEARCHED:
            _refuse_what_cannot_be_searched(points)
        searched = TOURS[spec.tour](wanted)
    visits = points.quaternions[list(list_visits(searched.order, closed=spec.closed))]
    length = float(np.sum(angle_between(visits[:-1], visits[1:])))
    minimal = find_minimal_distance(points.quaternions)
    merits = searched.merits
    if not any(merit.name == LENGTH for merit in merits):
        legs = len(points) - 1 + spec.closed
        short = length <= legs * (minimal + NEIGHBOUR_TOLERANCE)
        bound = length if short else legs * minimal
        merits = (Merit(LENGTH, length, bound, MINIMAL, asked=False), *merits)
    return Tour(searched.order, spec.closed, length, minimal, merits)


def sharpen(found: Tour, points: OrientationSet, progress: Progress | None = None) -> Tour:
    """The tour with the best bound on its length that can be computed, for tours with free ends."""
    if found.is_shortest or len(points) > MOST_ORIENTATIONS or len(points) < 3:
        return found
    costs, ends = measure_costs(points.quaternions), Ends(found.closed)
    bound = bound_length(costs, found.minimal, ends, found.length, progress)
    known = next(merit for merit in found.merits if merit.name == LENGTH)
    if known.proof != MINIMAL or bound.bound <= known.bound:
        return found
    return replace(found, merits=tuple(bound if merit is known else merit for merit in found.merits))


def read_ends(spec: RouteModel, points: OrientationSet) -> Ends:
    """The ends a problem asks for, as indices.

    Raises:
        InputError: a label that no orientation has.
    """
    found: dict[str, int | None] = {}
    for key, label in (("start", spec.start), ("end", spec.end)):
        if label is not None and label not in points.labels:
            raise InputError(Fault(_name_unknown(label, points), f"route.{key}"))
        found[key] = None if label is None else points.labels.index(label)
    return Ends(spec.closed, found["start"], found["end"])


def _refuse_what_cannot_be_searched(points: OrientationSet) -> None:
    if points.same:
        listing = list_some([f"{other} is {one}" for one, other in points.same])
        raise InputError(
            Fault(f"some orientations are the same: {listing}; add duplicates: merge", "route.orientations")
        )
    if len(points) > MOST_ORIENTATIONS:
        most = f"a tour is searched for {MOST_ORIENTATIONS} orientations at most, not for {len(points)}"
        raise _fault(f"{most}; merge them with a larger tolerance, or give the tour")
    if len(points) < 3:
        raise _fault("two orientations have one tour only; use given")


def _given(wanted: Wanted) -> Searched:
    """The order in which the orientations are listed."""
    return Searched(tuple(range(len(wanted.points))))


def _paper(wanted: Wanted) -> Searched:
    """The tour printed in [MMB2017] for the 24-cell."""
    if wanted.points.lattice != "24-cell":
        raise _fault(
            f'"paper" is the tour of the lattice 24-cell, not of {wanted.points.source}; '
            "use given, shortest or a list of labels"
        )
    return Searched(tuple(i - 1 for i in PAPER_TOUR))


def _shortest(wanted: Wanted) -> Searched:
    """Of least total angle."""
    q, precision = wanted.points.quaternions, wanted.points.precision.angle
    neighbours, minimal = list_neighbours(q, precision), find_minimal_distance(q)
    return find_shortest(measure_costs(q), neighbours, minimal, wanted.ends, wanted.progress)


def _fewest_stops(wanted: Wanted) -> Searched:
    """Of the tours by minimal legs one that goes straight on at the most nodes."""
    return _straightest(wanted, STRAIGHT)


def _least_turning(wanted: Wanted) -> Searched:
    """Of the tours by minimal legs one whose axis turns least."""
    return _straightest(wanted, TURNING)


def _straightest(wanted: Wanted, goal: str) -> Searched:
    points = wanted.points
    graph = MinimalLegs(points.quaternions, points.precision.angle)
    return find_straightest(graph, wanted.ends, goal, points.labels, wanted.progress)


def _fastest(wanted: Wanted) -> Searched:
    """Of least total time under the limits; the straightest tours known are where a search begins."""
    travel = make_travel_times(wanted.problem, wanted.points, wanted.progress)
    known = _straightest_known(wanted) if travel.straight_runs else ()
    return find_fastest(travel, wanted.ends, known, wanted.progress)


def _straightest_known(wanted: Wanted) -> Iterator[Order]:
    """The straightest tours of the set, made only when they are asked for."""
    for search in (_fewest_stops, _least_turning):
        try:
            yield search(wanted).order
        except InputError:  # the set has no such tour with these ends; the search does without
            continue


TOURS: dict[str, Callable[[Wanted], Searched]] = {
    "given": _given,
    "paper": _paper,
    "shortest": _shortest,
    "fewest-stops": _fewest_stops,
    "least-turning": _least_turning,
    "fastest": _fastest,
}


def _by_labels(labels: tuple[str, ...], points: OrientationSet, *, closed: bool) -> Order:
    """The order of a listed tour, in which an orientation may be visited more than once."""
    index = {label: i for i, label in enumerate(points.labels)}
    unknown = next((label for label in labels if label not in index), None)
    if unknown is not None:
        raise _fault(_name_unknown(unknown, points))
    visits = list_visits(labels, closed=closed)
    twice = next((one for one, other in pairwise(visits) if one == other), None)
    if twice is not None:
        hint = "; with closed: true the first one is not repeated" if closed and twice == labels[-1] else ""
        raise _fault(f'the tour visits "{twice}" twice in a row{hint}')
    there = set(labels)
    missing = [label for label in points.labels if label not in there]
    if missing:
        every = 'every orientation must be visited; "only" takes part of them'
        raise _fault(f"the tour leaves out {list_some(missing)}; {every}")
    return tuple(index[label] for label in labels)


def _name_unknown(label: str, points: OrientationSet) -> str:
    """What is said of a label that no orientation has."""
    merged = next((one for one, other in points.merged if other == label), None)
    if merged is not None:
        return f'"{label}" is the same orientation as "{merged}" and merged with it; say "{merged}"'
    return f'no orientation is called "{label}"; there are {list_some(points.labels)}'


def _fault(message: str) -> InputError:
    return InputError(Fault(message, "route.tour"))
