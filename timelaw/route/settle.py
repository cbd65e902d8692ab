"""Nodes settled on the great circles that they lie on within their precision, moved as little as need be."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between
from timelaw.orientations.precision import DOUBLES
from timelaw.route.chains import Chain, find_chains, is_short, measure_legs
from timelaw.route.great_circle import GreatCircle
from timelaw.route.joint_fit import JointFit

RAISED = 60  # rounds of weights raised where nodes move farthest
LIGHTEST = 1e-9  # of the largest weight
ROOM = 1 + 1e-9  # relative; moves are compared with the precision as they are, with their rounding


@dataclass(frozen=True)
class Settled:
    """Chains with their circles, the visits (n, 4) on them, and how far each was moved (n,) [rad].

    What is less than the rounding of doubles is no move.
    """

    chains: tuple[Chain, ...]
    visits: Array
    moves: Array


def settle_visits(points: Array, precision: float, *, closed: bool) -> Settled:
    """Cut visits (n, 4), unit quaternions, into chains, and move them onto the circles of these.

    No visit moves by more than `precision` [rad of body turn]; where chains that share nodes have no such
    circles together, one of them is cut where it fits worst. What lies on its circle to the rounding of
    doubles stays as it is. The first and the last visit of a closed tour stay one.
    """
    corners: set[int] = set()
    while True:
        chains = find_chains(points, precision, corners)
        visits, settled = np.array(points), list(chains)
        for group in _list_groups(chains, closed=closed):
            members = [chains[k] for k in group]
            circles, placed = _fit(points, members, precision, closed=closed)
            if not _holds(circles, placed, points, members, precision):
                moves = angle_between(points, placed)
                inside = (i for m in members for i in range(m.first + 1, m.last))
                corners.add(max(inside, key=lambda i: float(moves[i])))
                break
            for k, member, circle in zip(group, members, circles, strict=True):
                settled[k] = replace(member, circle=circle)
                visits[member.visits] = placed[member.visits]
        else:
            if closed:
                visits[[0, -1]] = visits[0] if np.any(visits[0] != points[0]) else visits[-1]
            moves = angle_between(points, visits)
            return Settled(tuple(settled), visits, np.where(moves > DOUBLES, moves, 0.0))


def _list_groups(chains: Sequence[Chain], *, closed: bool) -> list[list[int]]:
    """Indices of the chains of more than one leg, those together that share nodes."""
    groups: list[list[int]] = []
    for k, chain in enumerate(chains):
        if chain.circle is None:
            continue
        if groups and groups[-1][-1] == k - 1:
            groups[-1].append(k)
        else:
            groups.append([k])
    round_the_start = closed and len(groups) > 1 and groups[0][0] == 0 and groups[-1][-1] == len(chains) - 1
    return [groups[-1] + groups[0], *groups[1:-1]] if round_the_start else groups


def _fit(
    points: Array, members: Sequence[Chain], precision: float, *, closed: bool
) -> tuple[list[GreatCircle], Array]:
    """Circles of chains that share nodes, and the visits (n, 4) on them; the last try if none is good."""
    circles = [member.circle for member in members if member.circle is not None]
    apart = [circle.offsets(points[m.visits]) for circle, m in zip(circles, members, strict=True)]
    if max(map(np.max, apart)) <= DOUBLES / 2:
        return circles, points
    for found in _try_fits(points, members, circles, closed=closed):
        if _holds(*found, points, members, precision):
            break
    return found


def _try_fits(
    points: Array, members: Sequence[Chain], circles: Sequence[GreatCircle], *, closed: bool
) -> Iterator[tuple[list[GreatCircle], Array]]:
    """Least squares, first with shared nodes left where they are, then with the largest moves made less."""
    fit = JointFit(points, members, closed=closed)
    weights = np.ones(len(points))
    yield fit.solve(circles, weights, free=False)
    for _ in range(RAISED):
        found = fit.solve(circles, weights, free=True)
        yield found
        weights = weights * angle_between(points, found[1])
        weights = np.maximum(weights / np.max(weights), LIGHTEST)


def _holds(
    circles: Sequence[GreatCircle], placed: Array, points: Array, members: Sequence[Chain], precision: float
) -> bool:
    """Whether no visit has moved too far, and all legs go the right way."""
    far = float(np.max(angle_between(points, placed)))
    legs = (measure_legs(circle, placed[m.visits]) for circle, m in zip(circles, members, strict=True))
    return far <= precision * ROOM and all(is_short(angles, 2 * precision) for angles in legs)
