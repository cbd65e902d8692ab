"""Chains: stretches of a tour that lie on one great circle within the precision of the orientations."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.turn import HALF_TURN, choose_sense
from timelaw.route.great_circle import GreatCircle, fit_circle


@dataclass(frozen=True)
class Chain:
    """Visits `first` to `last` about one axis; `circle` runs in their sense, None for a single leg."""

    first: int
    last: int
    circle: GreatCircle | None = None

    @property
    def visits(self) -> slice:
        """Its visits."""
        return slice(self.first, self.last + 1)


def find_chains(points: Array, precision: float, corners: Collection[int] = ()) -> list[Chain]:
    """Visits (n, 4) cut into the fewest chains, from the first on; none goes on through one of the `corners`.

    All visits of a chain are within `precision` [rad of body turn] of its circle and follow each other
    along it the shorter way; a leg that is half a turn within twice that may go either way.
    """
    chains: list[Chain] = []
    first = 0
    while first < len(points) - 1:
        chain = Chain(first, first + 1)
        while chain.last + 1 < len(points) and chain.last not in corners:
            circle = _find_way(points[first : chain.last + 2], precision)
            if circle is None:
                break
            chain = Chain(first, chain.last + 1, circle)
        chains.append(chain)
        first = chain.last
    return chains


def measure_legs(circle: GreatCircle, points: Array) -> Array:
    """Rotation angles [0, 2π) of the body from each orientation (n, 4) to the next in the circle's sense."""
    return np.asarray(2 * np.mod(np.diff(circle.places(points)), np.pi))


def is_short(angles: Array, precision: float) -> bool:
    """Whether all legs go the shorter way, or are half-turns within twice the `precision`."""
    slack = 2 * max(HALF_TURN, precision)
    return bool(np.all((angles > 0) & (angles <= np.pi + slack)))


def _find_way(points: Array, precision: float) -> GreatCircle | None:
    """The circle of a chain, in its sense; where all legs are half-turns, in the documented one."""
    circle = fit_circle(points[-3:], precision) and fit_circle(points, precision)
    if circle is None:
        return None
    back = circle.reversed()
    ways = [way for way in (circle, back) if is_short(measure_legs(way, points), precision)]
    if len(ways) < 2:
        return ways[0] if ways else None
    sense = choose_sense(circle.axis, precision)
    return circle if float(sense @ circle.axis) > 0 else back
