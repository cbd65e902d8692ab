"""The route of a tour: legs, the nodes between them, and the runs the body can do without a stop."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from timelaw.errors import Fault, InputError
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import from_axis_angle, multiply
from timelaw.numerics.turn import SAME_ORIENTATION, angle_between_axes, choose_sense, find_turn
from timelaw.orientations import OrientationSet
from timelaw.route.chains import Chain, measure_legs
from timelaw.route.leg import Leg
from timelaw.route.settle import Settled, settle_visits
from timelaw.tours import Tour

NodeKind = Literal["start", "corner", "straight", "end"]


@dataclass(frozen=True)
class Node:
    """A visit: `turn` [rad] is the angle between the axes of the legs before and after.

    `moved` [rad] is how far the orientation was moved, within its precision, to go straight on.
    """

    label: str
    kind: NodeKind
    turn: float = 0.0
    moved: float = 0.0


@dataclass(frozen=True)
class Run:
    """A maximal chain of legs joined by straight nodes: it starts and ends at rest."""

    first: int
    angles: tuple[float, ...]

    @property
    def legs(self) -> range:
        """Indices of its legs in the route."""
        return range(self.first, self.first + len(self.angles))


@dataclass(frozen=True)
class Route:
    """Legs in order, and the nodes before, between and after them (one more than legs).

    `merged` are labels of visits that are one node with the visit before, by the index of that.
    """

    legs: tuple[Leg, ...]
    nodes: tuple[Node, ...]
    merged: Mapping[str, int] = field(default_factory=dict)

    @property
    def angles(self) -> Array:
        """Rotation angles θ (n,) of the legs [rad]."""
        return np.array([leg.angle for leg in self.legs])

    def runs(self, stops: Collection[int] = ()) -> tuple[Run, ...]:
        """The route cut at its corners, and at the nodes with the indices `stops`."""
        runs: list[Run] = []
        first = 0
        for index in range(1, len(self.nodes)):
            if self.nodes[index].kind != "straight" or index in stops:
                runs.append(Run(first, tuple(leg.angle for leg in self.legs[first:index])))
                first = index
        return tuple(runs)

    @property
    def moved(self) -> dict[str, float]:
        """Labels of the nodes that were moved, and how far [rad]."""
        return {node.label: node.moved for node in self.nodes if node.moved > 0}

    @property
    def straight_nodes(self) -> int:
        """How many nodes the body may pass at speed."""
        return sum(node.kind == "straight" for node in self.nodes)

    def orientation(self, sigma: ArrayLike) -> Array:
        """Unit quaternions (..., 4) at route parameters σ (...): leg number plus fraction of it.

        Raises:
            ValueError: outside [0, number of legs].
        """
        sigma = np.asarray(sigma, dtype=float)
        if np.any((sigma < 0) | (sigma > len(self.legs))):
            raise ValueError(f"route parameter outside [0, {len(self.legs)}]")
        index = np.minimum(sigma.astype(int), len(self.legs) - 1)
        start = np.array([leg.start for leg in self.legs])[index]
        axis = np.array([leg.axis for leg in self.legs])[index]
        return multiply(start, from_axis_angle(axis, self.angles[index] * (sigma - index)))


def lay_route(points: OrientationSet, tour: Tour, *, merge: bool = False) -> Route:
    """Join the visits of a tour by great-circle arcs; what is straight within their precision is straight.

    To `merge`: visits in a row of the same orientation are one node.

    Raises:
        InputError: two visits in a row are the same orientation.
    """
    order, precision = list(tour.visits()), points.precision.angle
    merged: dict[str, int] = {}
    if merge:
        order, merged = _merge_visits(points, order)
    labels = [points.labels[i] for i in order]
    visits = points.quaternions[order]
    for k, angle in enumerate(find_turn(visits[:-1], visits[1:]).angle):
        if angle < max(SAME_ORIENTATION, precision):
            message = f'"{labels[k]}" and "{labels[k + 1]}" follow each other and are the same orientation'
            origin = f"{points.precision.origin}: {np.degrees(precision):.3g}°"
            within = f" within their precision ({origin})" if precision > SAME_ORIENTATION else ""
            remedy = "leave one out, or add duplicates: merge to the orientations"
            raise InputError(Fault(f"{message}{within}; {remedy}", "route.tour"))
    settled = settle_visits(visits, precision, closed=tour.closed)
    legs = _lay_legs(labels, settled, precision)
    return Route(legs, _nodes(legs, settled), merged)


def _merge_visits(points: OrientationSet, order: Sequence[int]) -> tuple[list[int], dict[str, int]]:
    """The visits without those that are of the same orientation as the one before, and where these are."""
    kept, merged = [order[0]], {}
    same = max(SAME_ORIENTATION, points.precision.angle)
    for index in order[1:]:
        angle = float(find_turn(points.quaternions[kept[-1]], points.quaternions[index]).angle)
        if angle >= same:
            kept.append(index)
        elif points.labels[index] != points.labels[kept[-1]]:
            merged[points.labels[index]] = len(kept) - 1
    return (kept, merged) if len(kept) > 1 else (list(order), {})


def _lay_legs(labels: list[str], settled: Settled, precision: float) -> tuple[Leg, ...]:
    """The legs of all chains, with signs that make the path continuous."""
    legs: list[Leg] = []
    start = settled.visits[0]
    for chain in settled.chains:
        axis, angles, half = _find_turns(chain, settled.visits[chain.visits], precision)
        for k, angle in enumerate(angles, chain.first):
            reached = multiply(start, from_axis_angle(axis, angle))
            visit = settled.visits[k + 1]
            end = visit if float(reached @ visit) >= 0 else -visit
            legs.append(Leg(labels[k], labels[k + 1], start, end, axis, float(angle), half[k - chain.first]))
            start = end
    return tuple(legs)


def _find_turns(chain: Chain, visits: Array, precision: float) -> tuple[Array, Array, list[bool]]:
    """Axis (3,) and angles (n,) of the legs of a chain, and which of them are half-turns.

    A half-turn by itself, about n or -n, has the sense whose first non-zero component is positive.
    """
    turns = find_turn(visits[:-1], visits[1:], precision)
    half = [bool(one) for one in turns.half]
    if chain.circle is not None:
        return chain.circle.axis, measure_legs(chain.circle, visits), half
    axis = choose_sense(turns.axis[0], precision) if half[0] else turns.axis[0]
    other_way = float(axis @ turns.axis[0]) < 0
    return axis, 2 * np.pi - turns.angle if other_way else turns.angle, half


def _nodes(legs: tuple[Leg, ...], settled: Settled) -> tuple[Node, ...]:
    """The visits: straight on inside of chains, where the axis is the same vector before and after."""
    ends = {chain.first for chain in settled.chains}
    moved = [float(move) for move in settled.moves]
    inner = [
        Node(
            before.target,
            "corner" if k in ends else "straight",
            angle_between_axes(before.axis, after.axis),
            moved[k],
        )
        for k, (before, after) in enumerate(pairwise(legs), 1)
    ]
    first, last = Node(legs[0].origin, "start", 0.0, moved[0]), Node(legs[-1].target, "end", 0.0, moved[-1])
    return (first, *inner, last)
