"""Which variables a curve has: the columns of its pieces, counted through, without those that are fixed."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import multiply, normalise
from timelaw.through.curve import ALPHA, KNOT, OMEGA, TURN, Curve

FIXED = -1
LEAST_WEIGHT, LARGEST_WEIGHT = -0.5, 3.0  # of inner points, beyond which |Q| nearly vanishes between them

Index = NDArray[np.int64]


@dataclass(frozen=True)
class Columns:
    """Numbers of the variables of knots (n, 9), legs (K,), weights (Kp,) and inner points (Kp, 3(d-5))."""

    knots: Index
    legs: Index
    weights: Index
    inner: Index
    count: int

    @cached_property
    def of_pieces(self) -> Index:
        """(Kp, v), in the order of a piece's own columns."""
        pieces = len(self.knots) - 1
        legs = np.repeat(self.legs, pieces // len(self.legs))[:, None]
        own = [self.weights[:, None], self.inner] if self.inner.shape[1] else []
        return np.concatenate([self.knots[:-1], self.knots[1:], legs, *own], axis=1)

    def scales(self, curve: Curve, angles: Array) -> Array:
        """What counts as one (count,): angles of legs (K,), and their times."""
        part = np.repeat(angles, curve.pieces) / curve.pieces
        near = np.sqrt(np.concatenate([part[:1], part]) * np.concatenate([part, part[-1:]]))
        time = np.sqrt(
            np.concatenate([curve.steps[:1], curve.steps]) * np.concatenate([curve.steps, curve.steps[-1:]])
        )
        rows = np.stack([near / time] * 3 + [near / time**2] * 3 + [near] * 3, axis=1)
        found = np.ones(self.count)
        found[self.knots[self.knots >= 0]] = rows[self.knots >= 0]
        found[self.legs] = curve.duration
        if self.inner.shape[1]:
            found[self.inner] = part[:, None]
        return found

    def bounds(self, curve: Curve, radius: float) -> tuple[Array, Array]:
        """How far down and up each scaled variable may go: the trust region, and the weights' bounds."""
        down, up = np.full((2, self.count), radius)
        if self.inner.shape[1]:
            down[self.weights] = np.clip(curve.weight - LEAST_WEIGHT, 0.0, radius)
            up[self.weights] = np.clip(LARGEST_WEIGHT - curve.weight, 0.0, radius)
        return down, up

    def move(self, curve: Curve, step: Array) -> Curve:
        """The curve with its variables changed by a step (count,)."""
        knots = np.where(self.knots >= 0, step[np.maximum(self.knots, 0)], 0.0)
        turn = curve.turn
        if np.any(self.knots[:, TURN] >= 0):
            moved = normalise(multiply(turn, np.hstack([np.ones((len(turn), 1)), knots[:, TURN]])))
            turn = np.where(self.knots[:, TURN.start, None] >= 0, moved, turn)
        changed = replace(
            curve,
            turn=turn,
            omega=curve.omega + knots[:, OMEGA],
            alpha=curve.alpha + knots[:, ALPHA],
            duration=curve.duration + step[self.legs],
        )
        if not self.inner.shape[1]:
            return changed
        inner = curve.inner + step[self.inner].reshape(curve.inner.shape)
        return replace(changed, weight=curve.weight + step[self.weights], inner=inner)


def number_columns(curve: Curve, rests: NDArray[np.bool_]) -> Columns:
    """Variables of a curve whose nodes (K+1,) are fixed in orientation, and those at `rests` in rates."""
    knots = np.full((len(curve.turn), KNOT), FIXED)
    inside = np.ones(len(knots), dtype=bool)
    inside[:: curve.pieces] = False
    still = np.zeros(len(knots), dtype=bool)
    still[:: curve.pieces] = rests
    free = np.zeros(knots.shape, dtype=bool)
    free[:, :6] = ~still[:, None]
    free[:, TURN] = inside[:, None]
    knots[free] = np.arange(np.count_nonzero(free))
    count = int(np.count_nonzero(free))
    sizes = [len(curve.duration), len(curve.weight) if curve.inner.shape[1] else 0, curve.inner.size]
    legs, weights, inner = np.split(np.arange(count, count + sum(sizes)), np.cumsum(sizes)[:-1])
    return Columns(knots, legs, weights, inner.reshape(len(curve.weight), -1), count + sum(sizes))
