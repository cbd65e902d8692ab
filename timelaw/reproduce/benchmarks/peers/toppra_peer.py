"""toppra: the fastest way along a path that is given, under limits on velocity and acceleration."""

from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from timelaw.errors import Fault, InfeasibleError
from timelaw.numerics.array import Array
from timelaw.reproduce.benchmarks.peers.arcs import Profile, accelerate_constantly, follow_arcs
from timelaw.reproduce.benchmarks.peers.motion import Course, Motion, Peer
from timelaw.reproduce.benchmarks.peers.scipy_peer import place_nodes

POINTS = 60  # of its grid, for each leg
DIRECTIONS = 24  # of a half-plane, in which |α| is bounded: inside the circle by 0.2 % at most
ARCS = (
    "one coordinate, the angle along the arc, from rest to rest, legs about one axis put together. It has "
    "no jerk limit: the acceleration jumps, so that it stands here for what that limit costs"
)
PAST = (
    "along the curve of RotationSpline through all nodes, from rest to rest, |ω| and |α| as norms (24 "
    "directions of their plane at each point of the grid, inside by 0.2 % at most). No jerk limit again, "
    "and between its points nothing is bounded; the curve is given to it, not found by it"
)


class ProjectedRates:
    """A path as toppra asks for it: rates along a curve of rotations, on directions of the plane of both.

    With W = dR/ds as angular rate, ω = W ṡ and α = W s̈ + W' ṡ² lie in the plane of W and W'; their parts
    in directions of that plane bound their norms.
    """

    def __init__(self, curve: Any, last: float, half: Array) -> None:
        self.curve, self.last, self.half = curve, last, half
        self.waypoints = None

    @property
    def dof(self) -> int:
        """How many directions there are."""
        return len(self.half)

    @property
    def path_interval(self) -> Array:
        """Where the path begins and ends."""
        return np.array([0.0, self.last])

    def __call__(self, s: Any, order: int = 0) -> Array:
        """The parts (m, n) of W for order 1, of W' for order 2; of the place there are none."""
        s = np.atleast_1d(np.asarray(s, dtype=float))
        first = self.curve(s, 1)
        size = np.linalg.norm(first, axis=1)
        if order < 2:
            return np.outer(size, np.cos(self.half)) if order else np.zeros((len(s), self.dof))
        second = self.curve(s, 2)
        along = np.sum(first * second, axis=1) / size
        across = np.linalg.norm(second - (along / size)[:, None] * first, axis=1)
        return np.outer(along, np.cos(self.half)) + np.outer(across, np.sin(self.half))


def pass_grid(path: Any, limits: tuple[float, float, float], grid: Array, part: Array) -> Array:
    """The fastest rates ṡ (n,) on a grid, from rest to rest.

    In each direction |ω| has `part` (m,) of its limit, so that it is bounded as a norm.
    """
    import toppra

    toppra.setup_logging("ERROR")
    velocity = np.outer(limits[0] * part, [-1.0, 1.0])
    acceleration = np.outer(np.full(path.dof, limits[1]), [-1.0, 1.0])
    bounds = [
        toppra.constraint.JointVelocityConstraint(velocity),
        toppra.constraint.JointAccelerationConstraint(acceleration),
    ]
    solver = toppra.algorithm.TOPPRA(bounds, path, gridpoints=grid, solver_wrapper="seidel")
    _, rates, *_ = solver.compute_parameterization(0.0, 0.0)
    if rates is None:
        raise InfeasibleError(Fault("no parameterisation", "toppra"))
    return np.asarray(rates)


def solve_angle(limits: tuple[float, float, float], angle: float) -> Profile:
    """The fastest law of one angle, without a limit of jerk."""
    import toppra

    grid = np.linspace(0.0, angle, POINTS + 1)
    path = toppra.SplineInterpolator([0.0, angle], [[0.0], [angle]])
    instants, locate = accelerate_constantly(grid, pass_grid(path, limits, grid, np.ones(1)))
    return Profile(float(instants[-1]), locate)


def _follow(course: Course) -> Motion:
    return follow_arcs(course, partial(solve_angle, course.limits), merged=True)


def _pass(course: Course) -> Motion:
    places, spline = place_nodes(course)
    grid = np.concatenate([np.linspace(a, b, POINTS, endpoint=False) for a, b in pairwise(places)])
    grid = np.append(grid, places[-1])
    half = (np.arange(DIRECTIONS) + 0.5) * np.pi / DIRECTIONS - np.pi / 2
    inside = np.cos(np.pi / (2 * DIRECTIONS))
    limits = (course.limits[0], course.limits[1] * inside, course.limits[2])
    path = ProjectedRates(spline, float(places[-1]), half)
    instants, locate = accelerate_constantly(grid, pass_grid(path, limits, grid, np.abs(np.cos(half))))
    times = instants[::POINTS]
    return Motion(times, lambda t: spline(np.clip(locate(t), 0.0, places[-1])).as_quat(scalar_first=True))


PEERS = (
    Peer("toppra, arcs", "toppra", ARCS, lambda course: partial(_follow, course)),
    Peer("toppra, RotationSpline", "toppra", PAST, lambda course: partial(_pass, course)),
)
