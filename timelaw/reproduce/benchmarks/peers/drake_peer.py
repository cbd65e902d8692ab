"""Drake's KinematicTrajectoryOptimization: B-splines whose control points keep the limits."""

from functools import partial
from typing import Any

import numpy as np

from timelaw.errors import Fault, InfeasibleError
from timelaw.numerics.array import Array
from timelaw.reproduce.benchmarks.peers.arcs import Profile, follow_arcs
from timelaw.reproduce.benchmarks.peers.motion import Course, Motion, Peer

SETUP = (
    "one coordinate, the angle along the arc, a B-spline from rest to rest, legs about one axis put "
    "together; velocity, acceleration and jerk are bounded at control points, so that the limits hold for "
    "all t, and the solver is the one Drake chooses (SNOPT). Its coordinates are of a flat space and its "
    "bounds of axes: no norm, no attitude, so that it cannot go past a corner"
)
ROOM = (0.1, 2.0)  # of the quintic's time, for the time of the law


def solve_angle(limits: tuple[float, float, float], degree: int, points: int, angle: float) -> Profile:
    """The fastest spline of one angle from rest to rest, from the quintic."""
    from pydrake.planning import KinematicTrajectoryOptimization
    from pydrake.solvers import Solve
    from pydrake.trajectories import BsplineTrajectory

    w, a, j = limits
    quintic = max(15 / 8 * angle / w, (10 / 3**0.5 * angle / a) ** (1 / 2), (60 * angle / j) ** (1 / 3))
    program = KinematicTrajectoryOptimization(1, points, degree + 1, quintic)
    program.AddDurationCost(1.0)
    program.AddDurationConstraint(ROOM[0] * quintic, ROOM[1] * quintic)
    for end, place in ((0.0, 0.0), (1.0, angle)):
        program.AddPathPositionConstraint([place], [place], end)
        program.AddPathVelocityConstraint([0.0], [0.0], end)
        program.AddPathAccelerationConstraint([0.0], [0.0], end)
    program.AddVelocityBounds([-w], [w])
    program.AddAccelerationBounds([-a], [a])
    program.AddJerkBounds([-j], [j])
    tau = np.linspace(0.0, 1.0, points)
    start = angle * (6 * tau**5 - 15 * tau**4 + 10 * tau**3)
    program.SetInitialGuess(BsplineTrajectory(program.basis(), start[None, :]))
    result = Solve(program.prog())
    if not result.is_success():
        raise InfeasibleError(Fault(str(result.get_solution_result()), "drake"))
    found = program.ReconstructTrajectory(result)
    return Profile(found.end_time(), partial(_evaluate, found))


def _evaluate(found: Any, t: Array) -> Array:
    return np.asarray(found.vector_values(t)[0])


def _go(course: Course, degree: int, points: int) -> Motion:
    return follow_arcs(course, partial(solve_angle, course.limits, degree, points), merged=True)


PEERS = (
    Peer(
        "Drake, degree 3 × 27",
        "drake",
        SETUP,
        lambda course: partial(_go, course, 3, 30),
    ),
    Peer(
        "Drake, degree 4 × 50",
        "drake",
        "the same with 50 intervals of degree 4, jerk continuous",
        lambda course: partial(_go, course, 4, 54),
    ),
)
