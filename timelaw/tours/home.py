"""An attitude from which the body sets out on its tour, and to which it returns."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from timelaw.errors import Fault, InputError
from timelaw.numerics.quaternion import angle_between, normalise
from timelaw.numerics.turn import SAME_ORIENTATION
from timelaw.orientations import OrientationSet
from timelaw.tours.merit import LENGTH, Merit
from timelaw.tours.tour import Tour

HOME = "home"
PROOF = "the bound on the tour in between, and twice the way from home to the nearest orientation"


def go_home(points: OrientationSet, tour: Tour, home: Sequence[float]) -> tuple[OrientationSet, Tour]:
    """The set with `home` (4,), and the tour with home before and after it.

    Where the tour begins or ends at home already, nothing is added at that end.

    Raises:
        InputError: an orientation is called "home" already.
    """
    q = normalise(home)
    away = angle_between(points.quaternions, q)
    there = away <= max(SAME_ORIENTATION, points.precision.angle)
    before, after = (not there[tour.order[end]] for end in (0, -1))
    if not before and not after:
        return points, tour
    if HOME in points.labels:
        raise InputError(Fault(f'an orientation is called "{HOME}" already; rename it', "route.home"))
    number = len(points)
    order = (*(number,) * before, *tour.order, *(number,) * after)
    longer = sum(float(away[tour.order[end]]) for end, added in ((0, before), (-1, after)) if added)
    length = tour.length + longer
    inner = next(merit for merit in tour.merits if merit.name == LENGTH)
    least = inner.bound + int(before + after) * float(np.min(away))
    merits = (Merit(LENGTH, length, min(least, length), PROOF, asked=inner.asked),)
    labels = (*points.labels, HOME)
    whole = replace(points, quaternions=np.vstack([points.quaternions, q]), labels=labels, lattice=None)
    return whole, Tour(order, tour.closed, length, min(tour.minimal, float(np.min(away))), merits)
