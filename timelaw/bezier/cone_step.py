"""One step of the search: limits to first order at points, as second-order cones, in a trust region."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from timelaw.bezier.legs import Choice, Run
from timelaw.bezier.rates import STATES, derive_parts, list_used
from timelaw.numerics.array import Array
from timelaw.through.cones import HEAD, solve_cones

SPARSE = 4  # every so many points are rows, breaks of splines among them; others only where they are maxima
NEAR = 0.7  # of a limit: maxima below it are no rows of their own
SLOW = 0.5  # u' below that part of its mean is held from turning back
TINY = 1e-200  # of a row; so small a one is none


def solve_step(run: Run, choice: Choice, radius: float) -> tuple[Array | None, int]:
    """The step (n,) that makes the time least to first order, None if none is found; and how many rows."""
    scales = _scale(run, choice)
    linear, right, cones, heads = _linearise(run, choice)
    identity = sparse.identity(len(scales), format="csc")
    linear, right = _drop_far(linear * scales, right, radius)
    cones, heads = _drop_far_cones(cones * scales, heads, radius)
    sizes = np.maximum(np.max(np.abs(linear), axis=1, initial=0.0), TINY)
    matrix = np.concatenate([linear / sizes[:, None], cones])
    cost = np.zeros(len(scales))
    cost[: len(run.legs)] = choice.durations / choice.total
    found = solve_cones(
        cost,
        sparse.vstack([identity, -identity, sparse.csc_matrix(matrix)], format="csc"),
        np.concatenate([np.full(2 * len(scales), radius), right / sizes, heads]),
        (2 * len(scales) + len(linear), 0, len(cones) // HEAD),
    )
    return None if found is None else found * scales, len(linear) + len(cones)


def _drop_far(rows: Array, right: Array, radius: float) -> tuple[Array, Array]:
    """Rows a · x ≤ b that an x within the radius can reach: others, of any scale, spoil the solution."""
    near = np.sum(np.abs(rows), axis=1) * radius > right
    return rows[near], right[near]


def _drop_far_cones(rows: Array, heads: Array, radius: float) -> tuple[Array, Array]:
    """The same of cones of a size of at most one."""
    blocks, value = rows.reshape(-1, HEAD, rows.shape[1]), heads.reshape(-1, HEAD)
    reach = np.abs(value[:, 1:]) + np.sum(np.abs(blocks[:, 1:]), axis=2) * radius
    near = np.linalg.norm(reach, axis=1) > value[:, 0]
    return blocks[near].reshape(-1, rows.shape[1]), value[near].ravel()


def _linearise(run: Run, choice: Choice) -> tuple[Array, Array, Array, Array]:
    """Rows A x ≤ b of components and of u' ≥ 0, and rows of cones b - A x, with their b."""
    linear: list[Array] = []
    right: list[Array] = []
    cones: list[Array] = []
    heads: list[Array] = []
    for k, leg in enumerate(run.legs):
        states, slopes = choice.states(run, k), _state_slopes(run, choice, k)
        parts, inner = derive_parts(leg.curve, leg.limits, states, leg.total)
        used = list_used(parts, leg.limits)
        for index, split in enumerate(leg.limits):
            at = _choose_points(used[index])
            value = parts[index][:, at]
            slope = np.einsum("cms,msv->cmv", inner[index][:, at], slopes[at], optimize=True)
            if split.by_axis:
                for sign in (1.0, -1.0):
                    linear.append(sign * slope.reshape(-1, slope.shape[2]))
                    right.append(1 - sign * value.ravel())
                continue
            block = np.concatenate([np.zeros((1, *slope.shape[1:])), -slope])
            cones.append(block.swapaxes(0, 1).reshape(-1, slope.shape[2]))
            heads.append(np.concatenate([np.ones((1, len(at))), value]).T.ravel())
        slow = np.flatnonzero(states[1:-1, 1] * choice.durations[k] < SLOW) + 1
        linear.append(-slopes[slow, 1])
        right.append(np.maximum(states[slow, 1], 0.0))
    count = linear[0].shape[1]
    return (
        np.concatenate(linear),
        np.concatenate(right),
        np.concatenate([np.zeros((0, count)), *cones]),
        np.concatenate([np.zeros(0), *heads]),
    )


def _choose_points(used: Array) -> NDArray[np.int64]:
    """Every so many points, and where a limit is nearly used and at its largest."""
    padded = np.pad(used, 1, constant_values=-1.0)
    tops = (used >= padded[:-2]) & (used >= padded[2:]) & (used > NEAR)
    tops[::SPARSE] = True
    return np.flatnonzero(tops)


def _offsets(run: Run) -> Iterator[tuple[int, int]]:
    """Where the coefficients of each leg stand among the variables."""
    first = len(run.legs)
    for leg in run.legs:
        yield first, first + leg.basis.free
        first += leg.basis.free


def _scale(run: Run, choice: Choice) -> Array:
    """What counts as one: durations, a change of control points by one, rates that take a leg's time."""
    parts = [choice.durations]
    parts += [1 / np.max(np.abs(leg.basis.from_free), axis=0, initial=TINY) for leg in run.legs]
    for k in range(len(run.passages)):
        time = float(min(choice.durations[k], choice.durations[k + 1]))
        parts.append(time ** -np.arange(1.0, run.continuity + 1))
    return np.concatenate(parts)


def _state_slopes(run: Run, choice: Choice, k: int) -> Array:
    """∂(u, u', …)/∂(all variables) (m, 5, n) on a leg."""
    leg, r, count = run.legs[k], run.continuity, len(run.legs)
    offsets = list(_offsets(run))
    first, last = offsets[k]
    variables = offsets[-1][1] + len(run.passages) * r
    control = np.zeros((leg.basis.from_left.shape[0], variables))
    control[:, first:last] = leg.basis.from_free
    time = float(choice.durations[k])
    powers, grown = time ** np.arange(1.0, r + 1), np.arange(1.0, r + 1) * time ** np.arange(0.0, r)
    joints = offsets[-1][1]
    if k:
        passage, rates = run.passages[k - 1], choice.rates[k - 1]
        own = slice(joints + (k - 1) * r, joints + k * r)
        left = leg.basis.from_left[:, 1:]
        control[:, own] += left @ (powers[:, None] * passage.slope(rates))
        control[:, k] += left @ (grown * passage.carry(rates))
    if k < count - 1:
        own = slice(joints + k * r, joints + (k + 1) * r)
        right = leg.basis.from_right[:, 1:]
        control[:, own] += right * powers
        control[:, k] += right @ (grown * choice.rates[k])
    orders = np.arange(float(STATES))
    found = np.einsum("smc,cv->msv", leg.derivatives, control, optimize=True)
    found /= (time**orders)[None, :, None]
    found[:, :, k] -= choice.states(run, k) * orders / time
    return np.asarray(found)


def move(run: Run, choice: Choice, step: Array) -> Choice | None:
    """The choice with its variables changed by a step; None where a time would vanish."""
    durations = choice.durations + step[: len(run.legs)]
    if np.any(durations <= 0):
        return None
    offsets = list(_offsets(run))
    free = tuple(x + step[a:b] for x, (a, b) in zip(choice.free, offsets, strict=True))
    return Choice(durations, free, choice.rates + step[offsets[-1][1] :].reshape(choice.rates.shape))
