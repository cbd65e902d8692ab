"""The instants at which formats sample a law, and all that is known there."""

from collections.abc import Iterator
from itertools import pairwise
from math import ceil, floor, log10

import numpy as np

from timelaw.errors import Fault, InputError
from timelaw.export.dynamics import measure_momentum, measure_torque
from timelaw.export.text_rows import cut_rows
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array

MAX_ROWS = 20_000_000  # 5 GB as CSV, written within some minutes
MAX_ROWS_FOUND = 2 * MAX_ROWS  # of a law that takes longer than the least time that was known before it
NEAR_END = 1e-6  # of a step: a row that close to the last instant is that instant, but for rounding
RATE_NAMES = {1: "w", 2: "a", 3: "j"}


def list_grid(law: QuaternionLaw, rate: float) -> Array:
    """The even grid of times (m,) at `rate` [1/s], and the last instant.

    Raises:
        InputError: there would be more than are written.
    """
    refuse_too_many_rows(law.duration, rate)
    return np.concatenate(list(cut_grid(law, rate)))


def cut_grid(law: QuaternionLaw, rate: float) -> Iterator[Array]:
    """The same in blocks."""
    count = count_rows(law.duration, rate)
    for block in cut_rows(count):
        t = np.arange(block.start, block.stop) / rate
        if block.stop == count:
            t[-1] = law.duration
        yield t


def list_instants(law: QuaternionLaw, rate: float) -> Array:
    """The even grid (m,) and the nodes: who interpolates between them cuts no corner.

    Raises:
        InputError: there would be more than are written.
    """
    nodes, near = law.times, NEAR_END / rate
    grid = list_grid(law, rate)
    place = np.clip(np.searchsorted(nodes, grid), 1, len(nodes) - 1)
    away = np.minimum(np.abs(grid - nodes[place - 1]), np.abs(grid - nodes[place]))
    return np.unique(np.concatenate([nodes, grid[away > near]]))


def sample_segments(law: QuaternionLaw, rate: float) -> Iterator[tuple[Segment, Array, Array]]:
    """Each segment with the instants τ (m,) and t (m,) that divide it evenly, at `rate` [1/s] at least.

    Raises:
        InputError: there would be more than are written.
    """
    refuse_too_many_rows(law.duration, rate)
    for segment, (start, end) in zip(law.segments, pairwise(law.times.tolist()), strict=True):
        tau = np.linspace(0.0, 1.0, count_rows(segment.duration, rate))
        times = start + (end - start) * tau
        times[-1] = end
        yield segment, tau, times


def tabulate(law: QuaternionLaw, t: Array) -> dict[str, Array]:
    """Columns by name at the instants t (m,): t, quaternion, rates and what else is known; see `COLUMNS`."""
    q, *rates = law.evaluate(t, (0, *RATE_NAMES))
    found = {"t": t} | _name("q", "wxyz", q)
    for name, values in zip(RATE_NAMES.values(), rates, strict=True):
        found |= _name(name, "xyz", values)
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
    number = number_segments(law, t) - 1
    passed, left = t - law.times[number], law.times[number + 1] - t
    at_end = (left <= near) & (left < passed)
    at = at_end | (passed <= near) | np.array([not segment.moves for segment in law.segments])[number]
    origins, targets = zip(*((segment.origin, segment.target) for segment in law.segments), strict=True)
    labels = np.array([*origins, *targets, ""], dtype=object)
    found: list[str] = labels[np.where(at, number + at_end * len(origins), -1)].tolist()
    return found


def count_rows(duration: float, rate: float) -> int:
    """How many rows a motion of `duration` [s] has: those of the grid before its end, and the end."""
    return max(ceil(duration * rate - NEAR_END), 1) + 1


def refuse_too_many_rows(duration: float, rate: float, words: str = "", most: int = MAX_ROWS) -> None:
    """Say what rate is possible for a motion of `duration` [s]; `words` is "at least" if it may be longer.

    Raises:
        InputError: the table would have more rows than are written.
    """
    count = count_rows(duration, rate)
    if count > most:
        rows = f"{words} {count} rows in {duration:.6g} s".strip()
        possible = most / duration
        step = 10.0 ** (floor(log10(possible)) - 2)
        below = f"{floor(possible / step) * step:.6g} Hz"
        message = f"{rows}; at most {most} are written, choose a lower rate, below {below}"
        raise InputError(Fault(message, "output.rate"))


def _name(prefix: str, axes: str, values: Array) -> dict[str, Array]:
    return {prefix + axis: values[:, i] for i, axis in enumerate(axes)}
