"""The instants at which formats sample a law, and all that is known there."""

from collections.abc import Iterator
from itertools import pairwise
from math import ceil, floor, log10

import numpy as np

from timelaw.errors import Fault, InputError
from timelaw.export.dynamics import measure_momentum, measure_torque
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array

MAX_ROWS = 2_000_000
NEAR_END = 1e-6  # of a step: a row that close to the last instant is that instant, but for rounding
RATE_NAMES = {1: "w", 2: "a", 3: "j"}


def list_grid(law: QuaternionLaw, rate: float) -> Array:
    """The even grid of times (m,) at `rate` [1/s], and the last instant.

    Raises:
        InputError: there would be more than two million.
    """
    refuse_too_many_rows(law.duration, rate)
    return np.append(np.arange(count_rows(law.duration, rate) - 1) / rate, law.duration)


def list_instants(law: QuaternionLaw, rate: float) -> Array:
    """The even grid (m,) and the nodes: who interpolates between them cuts no corner.

    Raises:
        InputError: there would be more than two million.
    """
    nodes, near = law.times, NEAR_END / rate
    grid = list_grid(law, rate)
    place = np.clip(np.searchsorted(nodes, grid), 1, len(nodes) - 1)
    away = np.minimum(np.abs(grid - nodes[place - 1]), np.abs(grid - nodes[place]))
    return np.unique(np.concatenate([nodes, grid[away > near]]))


def sample_segments(law: QuaternionLaw, rate: float) -> Iterator[tuple[Segment, Array, Array]]:
    """Each segment with the instants τ (m,) and t (m,) that divide it evenly, at `rate` [1/s] at least.

    Raises:
        InputError: there would be more than two million in all.
    """
    refuse_too_many_rows(law.duration, rate)
    for segment, (start, end) in zip(law.segments, pairwise(law.times.tolist()), strict=True):
        tau = np.linspace(0.0, 1.0, count_rows(segment.duration, rate))
        times = start + (end - start) * tau
        times[-1] = end
        yield segment, tau, times


def tabulate(law: QuaternionLaw, t: Array) -> dict[str, Array]:
    """Columns by name at the instants t (m,): t, quaternion, rates and what else is known; see `COLUMNS`."""
    found = {"t": t}
    found |= _name("q", "wxyz", law(t))
    for order, name in RATE_NAMES.items():
        found |= _name(name, "xyz", law(t, order))
    if law.travels:
        found |= _name("", "xyz", law.place(t)) | _name("v", "xyz", law.place(t, 1))
    if law.body is not None:
        found |= _name("t", "xyz", measure_torque(law, t)) | _name("h", "xyz", measure_momentum(law, t))
    return found


COLUMNS = {  # what the names mean, and in which units
    "t": "time [s]",
    "qw qx qy qz": "unit quaternion, Hamilton, active, body to world",
    "wx wy wz": "angular velocity in body axes [rad/s]",
    "ax ay az": "angular acceleration in body axes [rad/s^2]",
    "jx jy jz": "angular jerk in body axes [rad/s^3]",
    "x y z": "place of the body's origin in the world [m], where it moves",
    "vx vy vz": "its velocity in the world [m/s]",
    "tx ty tz": "torque of the actuator in body axes [N m], where the inertia is known",
    "hx hy hz": "momentum in body axes [N m s]: of the body, or what the wheels store",
    "segment": "number of the segment, counted from 1",
    "node": "label of the node, where the body is at one",
}


def number_segments(law: QuaternionLaw, t: Array) -> Array:
    """The number (m,), counted from 1, of the segment at each instant; at a node the one after it."""
    return np.clip(np.searchsorted(law.times, t, side="right"), 1, len(law.segments))


def label_nodes(law: QuaternionLaw, t: Array, near: float) -> list[str]:
    """The label of the node at each instant (m,): during dwells, within `near` [s] of nodes; else empty."""
    found = []
    for instant, number in zip(t.tolist(), number_segments(law, t).tolist(), strict=True):
        segment = law.segments[number - 1]
        start, end = law.times[number - 1], law.times[number]
        at_end = end - instant <= near and end - instant < instant - start
        at = at_end or instant - start <= near or not segment.moves
        found.append((segment.target if at_end else segment.origin) if at else "")
    return found


def count_rows(duration: float, rate: float) -> int:
    """How many rows a motion of `duration` [s] has: those of the grid before its end, and the end."""
    return max(ceil(duration * rate - NEAR_END), 1) + 1


def refuse_too_many_rows(duration: float, rate: float, words: str = "") -> None:
    """Say what rate is possible for a motion of `duration` [s]; `words` is "at least" if it may be longer.

    Raises:
        InputError: the table would have more than two million rows.
    """
    count = count_rows(duration, rate)
    if count > MAX_ROWS:
        rows = f"{words} {count} rows in {duration:.6g} s".strip()
        possible = MAX_ROWS / duration
        step = 10.0 ** (floor(log10(possible)) - 2)
        below = f"{floor(possible / step) * step:.6g} Hz"
        message = f"{rows}; at most {MAX_ROWS} are written, choose a lower rate, below {below}"
        raise InputError(Fault(message, "output.rate"))


def _name(prefix: str, axes: str, values: Array) -> dict[str, Array]:
    return {prefix + axis: values[:, i] for i, axis in enumerate(axes)}
