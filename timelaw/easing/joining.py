"""Join pieces to an easing: neighbours share their states, and the whole ends exactly where it should.

Each piece starts where the one before it ends, as integration says. What rounding leaves at the end of
the leg is put into the least change of the highest derivative's control points.
"""

from functools import lru_cache

import numpy as np

from timelaw.numerics.array import Array, freeze
from timelaw.numerics.state_form import derive

KEPT = 16  # matrices that depend on nothing but the lengths of the pieces
REPETITIONS = 2  # the second takes what rounding left of the first


def join_pieces(
    durations: Array, controls: Array, start: Array, end: Array, *, smooth: bool
) -> tuple[Array, Array]:
    """States (m, p, c+1) at the starts of the pieces and `controls` (m, p, w) of the next derivative.

    For m profiles on pieces of the same `durations` (p,), all from the state `start` (c+1,) to `end` (c+1,).
    Where they are `smooth` the next derivative is continuous: neighbours share its control point.
    """
    controls = np.array(controls)
    if smooth:
        controls[:, 1:, 0] = controls[:, :-1, -1] = (controls[:, 1:, 0] + controls[:, :-1, -1]) / 2
    share = _sharing(*controls.shape[1:], smooth=smooth)
    effect = _end_effect(tuple(durations.tolist()), controls.shape[2], len(start)) @ share
    for _ in range(REPETITIONS):
        missing = end - _chain(durations, controls, start)[:, -1]
        # least-norm by the normal equations, which are of the size of a state
        weights = np.linalg.solve(effect @ effect.T, missing.T)
        controls = controls + (share @ (effect.T @ weights)).T.reshape(controls.shape)
    return _chain(durations, controls, start)[:, :-1], controls


def _sharing(count: int, width: int, *, smooth: bool) -> Array:
    """Matrix (count · width, free) from what may change to all control points."""
    if not smooth:
        return np.eye(count * width)
    owner = np.arange(count)[:, None] * (width - 1) + np.arange(width)
    return np.array(np.eye(count * (width - 1) + 1)[owner.ravel()])


@lru_cache(maxsize=KEPT)
def _end_effect(given: tuple[float, ...], width: int, size: int) -> Array:
    """Matrix (c+1, p · width): the state at the end of all, per control point."""
    durations = np.array(given)
    ends = np.cumsum(durations)
    effect = np.zeros((size, len(durations), width))
    for column in range(width):
        unit = np.zeros((len(durations), width))
        unit[:, column] = 1.0
        reached = _end_states(durations, np.zeros((len(durations), size)), unit)
        effect[:, :, column] = _carry(reached, ends[-1] - ends).T
    return freeze(effect.reshape(size, -1))


def _end_states(durations: Array, states: Array, controls: Array) -> Array:
    """States (p, c+1) at the ends of pieces: the highest derivative integrated once for each order."""
    ends = np.empty_like(states)
    for order in reversed(range(states.shape[1])):
        controls, _ = derive(durations, states[:, : order + 1], controls, order)
        ends[:, order] = controls[:, -1]
    return ends


def _carry(states: Array, times: Array) -> Array:
    """States (p, c+1) after further times (p,) in which the highest derivative of the state stays."""
    carried = states.copy()
    for order in range(states.shape[1]):
        term = np.ones_like(times)
        for further, higher in enumerate(range(order + 1, states.shape[1]), 1):
            term = term * times / further
            carried[:, order] += term * states[:, higher]
    return carried


def _chain(durations: Array, controls: Array, start: Array) -> Array:
    """States (m, p+1, c+1) at the starts of the pieces and at the end of the last, one after the other."""
    count, pieces, width = controls.shape
    own = _end_states(
        np.tile(durations, count), np.zeros((count * pieces, len(start))), controls.reshape(-1, width)
    ).reshape(count, pieces, -1)
    states = [np.tile(start, (count, 1))]
    for piece, duration in enumerate(durations):
        states.append(_carry(states[-1], np.full(count, duration)) + own[:, piece])
    return np.stack(states, axis=1)
