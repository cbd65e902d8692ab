"""The rates of many arcs: at the edges of pieces, and the largest. All that a proof needs but the limits."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from timelaw.easing.piece_stack import stack_profiles
from timelaw.easing.profile import Profile
from timelaw.motion.segment import RATES, Edges
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import integrate_square
from timelaw.numerics.extrema import find_largest


def list_edges(profiles: Sequence[Profile], directions: Array) -> list[Edges]:
    """Of arcs run through by these profiles, about unit axes (n, 3)."""
    counts = [len(profile.pieces) for profile in profiles]
    ends, sums = np.empty((len(RATES), sum(counts), 2)), np.empty((len(RATES), sum(counts)))
    for stack in stack_profiles(profiles):
        for k, order in enumerate(RATES):
            control = stack.derivative(order).control
            ends[k, stack.piece] = control[:, [0, -1]]
            sums[k, stack.piece] = stack.durations * np.sqrt(integrate_square(control))
    lasts = np.cumsum(counts)
    firsts = lasts - np.array(counts)
    sides = np.stack([ends[:, firsts, 0], ends[:, lasts - 1, 1]], axis=2)[..., None] * directions[:, None]
    gaps = (ends[:, 1:, 0] - ends[:, :-1, 1])[..., None] * np.repeat(directions, counts, axis=0)[1:]
    totals = np.add.reduceat(sums, firsts.tolist(), axis=1)
    return [
        Edges(sides[:, k], gaps[:, first : last - 1], totals[:, k])
        for k, (first, last) in enumerate(zip(firsts.tolist(), lasts.tolist(), strict=True))
    ]


class JoinedAngles(NamedTuple):
    """Where a profile ends, its gaps between pieces added up, and its rounding likewise [rad]."""

    end: float
    gaps: float
    rounding: float


def join_angles(profile: Profile) -> JoinedAngles:
    """From one piece to the next."""
    ends, rounding = np.empty((len(profile.pieces), 2)), 0.0
    for stack in stack_profiles([profile]):
        angle = stack.derivative(0)
        ends[stack.piece] = angle.control[:, [0, -1]]
        rounding += float(np.sum(angle.error))
    return JoinedAngles(float(ends[-1, 1]), float(np.sum(np.abs(ends[1:, 0] - ends[:-1, 1]))), rounding)


def find_largest_rates(profiles: Sequence[Profile]) -> Array:
    """The largest first to fourth derivative (4,) of any."""
    stacks = stack_profiles(profiles)
    return np.array([max(find_largest(s.derivative(order).control) for s in stacks) for order in RATES])


def integrate_square_rates(profiles: Sequence[Profile], order: int) -> float:
    """Σ ∫ (φ^(k))² dt over all of them."""
    stacks = stack_profiles(profiles)
    return sum(float(s.durations @ integrate_square(s.derivative(order).control)) for s in stacks)
