"""SciPy's rotations: Slerp eased by the quintic, and RotationSpline through the nodes."""

from functools import partial

import numpy as np
from scipy.spatial.transform import Rotation, RotationSpline

from timelaw.numerics.array import Array
from timelaw.reproduce.benchmarks.peers.arcs import Profile, follow_arcs
from timelaw.reproduce.benchmarks.peers.judge import judge_motion
from timelaw.reproduce.benchmarks.peers.motion import Course, Motion, Peer

STEPS = 400  # of each leg, on which a spline is measured to be scaled


def ease_quintic(limits: tuple[float, float, float], angle: float) -> Profile:
    """The quintic 6τ⁵ - 15τ⁴ + 10τ³ over an angle, as fast as the limits allow."""
    peaks = (15 / 8, 10 / 3**0.5, 60.0)
    duration = max(
        (peak * angle / limit) ** (1 / k)
        for k, (peak, limit) in enumerate(zip(peaks, limits, strict=True), 1)
    )
    return Profile(duration, lambda t: angle * np.polyval([6, -15, 10, 0, 0, 0], t / duration))


def place_nodes(course: Course) -> tuple[Array, RotationSpline]:
    """Angles [rad] travelled to each node along the arcs, and RotationSpline through the nodes over these."""
    rotations = Rotation.from_quat(course.nodes, scalar_first=True)
    angles = (rotations[:-1].inv() * rotations[1:]).magnitude()
    places = np.concatenate([[0.0], np.cumsum(angles)])
    return places, RotationSpline(places, rotations)


def _slerp(course: Course) -> Motion:
    return follow_arcs(course, partial(ease_quintic, course.limits), merged=False)


def _spline(course: Course) -> Motion:
    places, spline = place_nodes(course)

    def at_speed(speed: float) -> Motion:
        return Motion(places / speed, lambda t: spline(t * speed).as_quat(scalar_first=True))

    used = judge_motion(at_speed(1.0), course, STEPS).used
    return at_speed(1.0 / max(part ** (1 / order) for order, part in enumerate(used, 1)))


PEERS = (
    Peer(
        "SciPy Slerp, quintic",
        "scipy",
        "the paper's law: each leg by the quintic, as fast as the limits allow; no optimisation",
        lambda course: partial(_slerp, course),
    ),
    Peer(
        "SciPy RotationSpline",
        "scipy",
        "instants in proportion to the angles, then one factor of time so that the limits are kept on 400 "
        "points a leg, which is most of its time to compute; ω and α are continuous. It is already moving at "
        "its start and still at its end, and knows no limits",
        lambda course: partial(_spline, course),
    ),
)
