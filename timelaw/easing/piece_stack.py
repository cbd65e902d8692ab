"""The pieces of many profiles at once: those of one shape in one array, whose rates are found together."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from timelaw.easing.profile import Piece, Profile
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import evaluate
from timelaw.numerics.polynomial import PolynomialStack
from timelaw.numerics.state_form import derive

TOGETHER = 500  # profiles that are sampled at once


@dataclass(frozen=True)
class PieceStack:
    """Pieces of one shape, in their order: durations (g,), states (g, c+1), controls (g, m+1).

    `piece` (g,) are their numbers among the pieces of all profiles, `leg` (g,) those of their profiles;
    they last from `start` to `end` (g,) in τ. Rates that were asked for are kept.
    """

    piece: NDArray[np.int64]
    leg: NDArray[np.int64]
    start: Array
    end: Array
    durations: Array
    states: Array
    controls: Array
    _known: dict[int, PolynomialStack] = field(default_factory=dict, init=False, repr=False, compare=False)

    def derivative(self, order: int) -> PolynomialStack:
        """The polynomials d^k φ/dt^k, each over [0, 1], with their rounding."""
        if order not in self._known:
            self._known[order] = PolynomialStack(*derive(self.durations, self.states, self.controls, order))
        return self._known[order]


def stack_profiles(profiles: Sequence[Profile]) -> list[PieceStack]:
    """All pieces, by their shape."""
    pieces = [piece for profile in profiles for piece in profile.pieces]
    leg = np.repeat(np.arange(len(profiles)), [len(profile.pieces) for profile in profiles])
    start = np.concatenate([profile.breaks[:-1] for profile in profiles])
    end = np.concatenate([profile.breaks[1:] for profile in profiles])
    shapes: dict[tuple[int, int], list[int]] = defaultdict(list)
    for number, piece in enumerate(pieces):
        shapes[len(piece.state), len(piece.control)].append(number)
    stacks = []
    for numbers in shapes.values():
        own, at = [pieces[number] for number in numbers], np.array(numbers)
        stacks.append(PieceStack(at, leg[at], start[at], end[at], *_stack(own)))
    return stacks


def sample_profiles(profiles: Sequence[Profile], tau: Array, order: int) -> Array:
    """d^k φ/dt^k (n, m) of many profiles at the same τ (m,), at a break from the right."""
    value = np.empty((len(profiles), len(tau)))
    for first in range(0, len(profiles), TOGETHER):
        own = profiles[first : first + TOGETHER]
        value[first : first + len(own)] = _sample(own, tau, order)
    return value


def _sample(profiles: Sequence[Profile], tau: Array, order: int) -> Array:
    counts = [len(profile.pieces) for profile in profiles]
    found = [profile.find_pieces(tau, "right") for profile in profiles]
    piece = np.array([at for at, _ in found]) + (np.cumsum(counts) - counts)[:, None]
    u, value = np.array([part for _, part in found]), np.empty((len(profiles), len(tau)))
    row = np.full(sum(counts), -1)
    for stack in stack_profiles(profiles):
        row[:] = -1
        row[stack.piece] = np.arange(len(stack.piece))
        here = row[piece] >= 0
        value[here] = evaluate(stack.derivative(order).control[row[piece[here]]], u[here])
    return value


def _stack(pieces: Sequence[Piece]) -> tuple[Array, Array, Array]:
    """Durations, states and controls of pieces of one shape."""
    states = np.concatenate([piece.state for piece in pieces])
    controls = np.concatenate([piece.control for piece in pieces])
    count = len(pieces)
    durations = np.array([piece.duration for piece in pieces])
    return durations, states.reshape(count, -1), controls.reshape(count, -1)
