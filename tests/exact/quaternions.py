"""Unit quaternions as balls."""

from flint import arb

from tests.exact.rational import norm

Quaternion = list[arb]


def normalise(vector: list) -> list[arb]:
    """The unit vector."""
    length = norm(vector)
    return [arb(x) / length for x in vector]


def multiply(p: list, q: list) -> list:
    """Hamilton product."""
    return [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]


def measure_turn(p: Quaternion, q: Quaternion) -> arb:
    """Twice the angle on S³ between unit quaternions: 2π between q and -q."""
    apart = norm([a - b for a, b in zip(p, q, strict=True)])
    together = norm([a + b for a, b in zip(p, q, strict=True)])
    return 2 * 2 * arb.atan2(apart, together)
