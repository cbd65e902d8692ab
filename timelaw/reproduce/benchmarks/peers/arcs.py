"""Motions along the arcs of a course from a law of one angle over time: what programs for axes can do."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from timelaw.numerics.array import Array
from timelaw.reproduce.benchmarks.peers.motion import Course, Motion

SAME = 1e-9  # rad, of axes and angles


@dataclass(frozen=True)
class Profile:
    """A law of the angle from rest to rest: its time [s], and the angle [rad] (m,) at times (m,)."""

    duration: float
    angle: Callable[[Array], Array]


@dataclass(frozen=True)
class Turn:
    """A way about one axis (3,), of the body, from a rotation: legs of some angles [rad], without a stop."""

    start: Rotation
    axis: Array
    angles: tuple[float, ...]


def list_turns(course: Course, *, merged: bool) -> list[Turn]:
    """The legs; `merged`, those that go on about one axis are one turn."""
    rotations = Rotation.from_quat(course.nodes, scalar_first=True)
    turns: list[Turn] = []
    for k, vector in enumerate((rotations[:-1].inv() * rotations[1:]).as_rotvec()):
        angle = float(np.linalg.norm(vector))
        axis = vector / angle
        if merged and turns and np.linalg.norm(axis - turns[-1].axis) < SAME:
            last = turns[-1]
            turns[-1] = Turn(last.start, last.axis, (*last.angles, angle))
        else:
            turns.append(Turn(rotations[k], axis, (angle,)))
    return turns


def follow_arcs(course: Course, solve: Callable[[float], Profile], *, merged: bool) -> Motion:
    """Go along the arcs, every turn from rest to rest; equal angles are solved once."""
    turns = list_turns(course, merged=merged)
    solved: dict[int, Profile] = {}
    profiles = []
    for turn in turns:
        angle = sum(turn.angles)
        key = round(angle / SAME)
        if key not in solved:
            solved[key] = solve(angle)
        profiles.append(solved[key])
    begun = np.concatenate([[0.0], np.cumsum([profile.duration for profile in profiles])])
    times = [0.0]
    for turn, profile, start in zip(turns, profiles, begun, strict=False):
        passed = np.cumsum(turn.angles)[:-1]
        times += [float(start) + _find_instant(profile, angle) for angle in passed]
        times.append(float(start) + profile.duration)

    def evaluate(t: Array) -> Array:
        q = np.empty((len(t), 4))
        index = np.clip(np.searchsorted(begun, t, side="right") - 1, 0, len(turns) - 1)
        for k in np.unique(index):
            here = index == k
            angle = profiles[k].angle(np.clip(t[here] - begun[k], 0.0, profiles[k].duration))
            turned = turns[k].start * Rotation.from_rotvec(angle[:, None] * turns[k].axis)
            q[here] = turned.as_quat(scalar_first=True)
        return q

    return Motion(np.array(times), evaluate)


def _find_instant(profile: Profile, angle: float) -> float:
    """When the angle is reached."""

    def lack(t: float) -> float:
        return float(profile.angle(np.array([t]))[0]) - angle

    return float(brentq(lack, 0.0, profile.duration, xtol=1e-13 * profile.duration))


def accelerate_constantly(positions: Array, rates: Array) -> tuple[Array, Callable[[Array], Array]]:
    """Instants (n,) [s] of positions passed at rates (n,), and positions at times: constant acceleration."""
    steps = [
        2 * (b - a) / (u + v) for (a, b), (u, v) in zip(pairwise(positions), pairwise(rates), strict=True)
    ]
    instants = np.concatenate([[0.0], np.cumsum(steps)])

    def locate(t: Array) -> Array:
        k = np.clip(np.searchsorted(instants, t, side="right") - 1, 0, len(steps) - 1)
        since = t - instants[k]
        slope = (rates[k + 1] - rates[k]) / np.asarray(steps)[k]
        return np.asarray(positions[k] + since * (rates[k] + slope * since / 2))

    return instants, locate
