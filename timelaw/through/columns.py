"""Which variables a curve has: the columns of its pieces, counted through, without those that are fixed.

The rates of a node may be measured by the duration θ of its shorter leg, which changes with them: the
variables are then y_k = θ^k times the k-th rate. Where short legs stand among long ones, either way may
end at the faster curve.
"""

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import multiply, normalise
from timelaw.through.curve import Curve

FIXED = -1
LEAST_WEIGHT, LARGEST_WEIGHT = -0.5, 3.0  # of inner points, beyond which |Q| nearly vanishes between them
MOST_LESS = 0.9  # of a duration: how much of it one step may take away

Index = NDArray[np.int64]


@dataclass(frozen=True)
class Columns:
    """Numbers of the variables of knots (n, 3r+3), legs (K,), weights (Kp,) and inner points (Kp, ·).

    `clocks` (n,) is the leg by whose duration the rates of a knot are measured; none where by no leg's.
    """

    knots: Index
    legs: Index
    weights: Index
    inner: Index
    count: int
    clocks: Index | None = None

    @cached_property
    def of_pieces(self) -> Index:
        """(Kp, v), in the order of a piece's own variables, and after them the clocks of both knots."""
        pieces = len(self.knots) - 1
        legs = np.repeat(self.legs, pieces // len(self.legs))[:, None]
        own = [self.weights[:, None], self.inner] if self.inner.shape[1] else []
        clocks = (
            []
            if self.clocks is None
            else [self.legs[self.clocks[:-1, None]], self.legs[self.clocks[1:, None]]]
        )
        return np.concatenate([self.knots[:-1], self.knots[1:], legs, *own, *clocks], axis=1)

    def by_clock(self, curve: Curve, slopes: Array) -> Array:
        """Slopes (Kp, d+1, 4, v) by the rates as slopes by the variables of `of_pieces`."""
        if self.clocks is None:
            return slopes
        knot, _ = curve.columns
        found, more = slopes.copy(), []
        for first, own in ((0, slice(None, -1)), (knot, slice(1, None))):
            clock = curve.duration[self.clocks[own]]
            by_clock = np.zeros(slopes.shape[:-1])
            for k in range(curve.smooth):
                part = slice(first + 3 * k, first + 3 * k + 3)
                pull = curve.rates[own, k] * -((k + 1) / clock)[:, None]
                by_clock += np.einsum("poci,pi->poc", slopes[..., part], pull)
                found[..., part] /= clock[:, None, None, None] ** (k + 1)
            more.append(by_clock[..., None])
        return np.concatenate([found, *more], axis=-1)

    def scales(self, curve: Curve, angles: Array) -> Array:
        """What counts as one (count,): angles of legs (K,), and their times."""
        part = np.repeat(angles, curve.pieces) / curve.pieces
        near, time = (np.sqrt(np.append(v[0], v) * np.append(v, v[-1])) for v in (part, curve.steps))
        if self.clocks is not None:
            time = time / curve.duration[self.clocks]
        rows = [near / time**k for k in range(1, curve.smooth + 1) for _ in range(3)] + [near] * 3
        found = np.ones(self.count)
        free = self.knots >= 0
        found[self.knots[free]] = np.stack(rows, axis=1)[free]
        legs = self.legs >= 0
        found[self.legs[legs]] = curve.duration[legs]
        if self.inner.shape[1]:
            found[self.inner] = part[:, None]
        return found

    def bounds(self, curve: Curve, radius: float) -> tuple[Array, Array]:
        """How far down and up each scaled variable may go: the trust region, and the weights' bounds."""
        down, up = np.full((2, self.count), radius)
        legs = self.legs[self.legs >= 0]
        down[legs] = np.minimum(radius, MOST_LESS)
        if self.inner.shape[1]:
            down[self.weights] = np.clip(curve.weight - LEAST_WEIGHT, 0.0, radius)
            up[self.weights] = np.clip(LARGEST_WEIGHT - curve.weight, 0.0, radius)
        return down, up

    def move(self, curve: Curve, step: Array) -> Curve:
        """The curve with its variables changed by a step (count,)."""
        knots = np.where(self.knots >= 0, step[np.maximum(self.knots, 0)], 0.0)
        duration = curve.duration + np.where(self.legs >= 0, step[np.maximum(self.legs, 0)], 0.0)
        moved = knots[:, :-3].reshape(curve.rates.shape)
        rates = curve.rates + moved
        if self.clocks is not None:
            powers = np.arange(1, curve.smooth + 1)[:, None]
            before, after = (d[self.clocks][:, None, None] ** powers for d in (curve.duration, duration))
            free = self.knots[:, :-3].reshape(rates.shape) >= 0
            rates = np.where(free, (curve.rates * before + moved) / after, curve.rates)
        turn = curve.turn
        if np.any(self.knots[:, -3:] >= 0):
            turned = normalise(multiply(turn, np.hstack([np.ones((len(turn), 1)), knots[:, -3:]])))
            turn = np.where(self.knots[:, -3:-2] >= 0, turned, turn)
        changed = replace(curve, turn=turn, rates=rates, duration=duration)
        if not self.inner.shape[1]:
            return changed
        inner = curve.inner + step[self.inner].reshape(curve.inner.shape)
        return replace(changed, weight=curve.weight + step[self.weights], inner=inner)


def number_columns(
    curve: Curve,
    held: NDArray[np.bool_],
    *,
    periodic: bool = False,
    fixed: Collection[int] = (),
    clocks: bool = False,
) -> Columns:
    """Variables of a curve whose nodes (K+1,) are fixed in orientation, and the `held` ones in rates.

    `periodic`: the last node has the rates of the first. `fixed` legs keep their durations. `clocks`:
    rates are measured by the shorter leg's duration.
    """
    knot, _ = curve.columns
    knots = np.full((len(curve.turn), knot), FIXED)
    free = np.zeros(knots.shape, dtype=bool)
    still = np.zeros(len(knots), dtype=bool)
    still[:: curve.pieces] = held
    free[:, :-3] = ~still[:, None]
    inside = np.ones(len(knots), dtype=bool)
    inside[:: curve.pieces] = False
    free[:, -3:] = inside[:, None]
    if periodic:
        free[-1] = False
    knots[free] = np.arange(np.count_nonzero(free))
    if periodic:
        knots[-1, :-3] = knots[0, :-3]
    count = int(np.count_nonzero(free))
    legs = np.full(len(curve.duration), FIXED)
    open_ = np.array([k not in fixed for k in range(len(legs))])
    legs[open_] = count + np.arange(np.count_nonzero(open_))
    count += int(np.count_nonzero(open_))
    sizes = [len(curve.weight) if curve.inner.shape[1] else 0, curve.inner.size]
    weights, inner = np.split(np.arange(count, count + sum(sizes)), np.cumsum(sizes)[:-1])
    return Columns(
        knots,
        legs,
        weights,
        inner.reshape(len(curve.weight), -1),
        count + sum(sizes),
        _find_clocks(curve, periodic=periodic) if clocks else None,
    )


def _find_clocks(curve: Curve, *, periodic: bool) -> Index:
    """For each knot the shorter of the legs that meet there, by their present durations."""
    before = np.concatenate([[0], np.arange(len(curve.weight)) // curve.pieces])
    after = np.append(before[1:], before[-1])
    if periodic:
        before[0], after[-1] = before[-1], 0
    shorter = curve.duration[before] <= curve.duration[after]
    return np.where(shorter, before, after)
