"""The route of a tour: legs, the nodes between them, and the runs the body can do without a stop."""

from collections.abc import Collection
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from timelaw.errors import Fault, InputError
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import from_axis_angle, multiply
from timelaw.numerics.turn import (
    SAME_AXIS,
    SAME_ORIENTATION,
    Turn,
    angle_between_axes,
    choose_sense,
    find_turn,
)
from timelaw.orientations import OrientationSet
from timelaw.route.leg import Leg
from timelaw.tours import Tour

NodeKind = Literal["start", "corner", "straight", "end"]


@dataclass(frozen=True)
class Node:
    """A visit: `turn` [rad] is the angle between the axes of the legs before and after."""

    label: str
    kind: NodeKind
    turn: float = 0.0


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
    """Legs in order, and the nodes before, between and after them (one more than legs)."""

    legs: tuple[Leg, ...]
    nodes: tuple[Node, ...]

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


def lay_route(points: OrientationSet, tour: Tour) -> Route:
    """Join the visits of a tour by great-circle arcs.

    Raises:
        InputError: two visits in a row are the same orientation.
    """
    order = tour.visits()
    labels = [points.labels[i] for i in order]
    visits = points.quaternions[list(order)]
    turns = [find_turn(visits[k], visits[k + 1]) for k in range(len(order) - 1)]
    for k, turn in enumerate(turns):
        if turn.angle < SAME_ORIENTATION:
            message = f'"{labels[k]}" and "{labels[k + 1]}" follow each other and are the same orientation'
            remedy = "leave one out, or add duplicates: merge to the orientations"
            raise InputError(Fault(f"{message}; {remedy}", "route.tour"))
    axes = _settle_half_turns(turns)
    legs: list[Leg] = []
    start = visits[0]
    for k, turn in enumerate(turns):
        short = float(turn.angle)
        angle = short if float(axes[k] @ turn.axis) > 0 else 2 * np.pi - short
        reached = multiply(start, from_axis_angle(axes[k], np.array(angle)))
        end = visits[k + 1] if float(reached @ visits[k + 1]) >= 0 else -visits[k + 1]
        legs.append(Leg(labels[k], labels[k + 1], start, end, axes[k], angle, bool(turn.half)))
        start = end
    return Route(tuple(legs), _nodes(legs))


def _settle_half_turns(turns: list[Turn]) -> list[Array]:
    """Give half-turns the sense that goes straight on, from the leg before or into the leg after.

    Half-turns in a row about one axis get one sense together; without a neighbour to go on to,
    the one whose first non-zero component is positive.
    """
    axes, free = [turn.axis for turn in turns], [bool(turn.half) for turn in turns]
    settled, k = list(axes), 0
    while k < len(axes):
        end = k + 1
        if free[k]:
            while end < len(axes) and free[end] and _parallel(axes[k], axes[end]):
                end += 1
            neighbours = [settled[k - 1]] if k else []
            neighbours += [axes[end]] if end < len(axes) and not free[end] else []
            guide = next((n for n in neighbours if _parallel(axes[k], n)), choose_sense(axes[k]))
            settled[k:end] = [axis if float(axis @ guide) > 0 else -axis for axis in axes[k:end]]
        k = end
    return settled


def _parallel(first: Array, second: Array) -> bool:
    """Whether two axes are one line."""
    turn = angle_between_axes(first, second)
    return min(turn, np.pi - turn) <= SAME_AXIS


def _nodes(legs: list[Leg]) -> tuple[Node, ...]:
    inner = []
    for before, after in pairwise(legs):
        turn = angle_between_axes(before.axis, after.axis)
        inner.append(Node(before.target, "straight" if turn <= SAME_AXIS else "corner", turn))
    return (Node(legs[0].origin, "start"), *inner, Node(legs[-1].target, "end"))
