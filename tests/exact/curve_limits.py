"""Limits on rational segments: numerators of rates, torque and momentum over powers of D, and their maxima."""

from collections.abc import Callable

from flint import arb, arb_poly

from tests.exact.curves import Curve
from tests.exact.motion import Motion
from tests.exact.origins import NORM, Origin
from tests.exact.patches import Numerators, Patch
from tests.exact.rational import apply, cross, dot, largest, norm
from tests.exact.segments import Segment

RATE_ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3, "snap": 4}
LINEAR_ORDERS = {"linear_velocity": 1, "linear_acceleration": 2}


def measure_curves(motion: Motion, segment: Segment, name: str, axis: int) -> tuple[arb, float]:
    """The maximum of one limited quantity on a rational segment, and what it would be if nothing cancelled."""
    found = [_measure(motion, piece, name, axis) for piece in segment.pieces]
    return largest([maximum for maximum, _ in found]), max(gross for _, gross in found)


def measure_origins(origins: list[Origin], order: int, axis: int) -> tuple[arb, float]:
    """The maximum of a rate of the body's origin, and what it would be if nothing cancelled."""
    most = largest([origin.measure(order, axis) for origin in origins])
    return most, max(origin.gross(order) for origin in origins)


def _measure(motion: Motion, piece: Curve, name: str, axis: int) -> tuple[arb, float]:
    """On one piece: |V|/D^k, or one component."""
    if name in RATE_ORDERS:
        order = RATE_ORDERS[name]
        power, gross, body = order, piece.gross(order), None
        make: Callable[[Patch], Numerators] = lambda patch: patch.rate(order)  # noqa: E731
    else:
        body = motion.body
        power, make, gross = _choose_formula(motion, piece, name)

    def quotient(patch: Patch) -> tuple[arb_poly, arb_poly]:
        vector = make(patch)
        if axis == NORM:
            return dot(vector, vector), patch.power(2 * power)
        return vector[axis], patch.power(power)

    key = (name, axis, body)
    return piece.enclose(key, quotient, squared=axis == NORM, gross=gross), gross


def _choose_formula(
    motion: Motion, piece: Curve, name: str
) -> tuple[int, Callable[[Patch], Numerators], float]:
    """The power of D, the numerators, and the size without cancelling."""
    inertia = [[arb(x) for x in row] for row in motion.inertia]
    most = max(sum(abs(float(x)) for x in row) for row in motion.inertia)
    total = float(norm(motion.total).mid())

    def carry(vector: Numerators) -> Numerators:
        return apply(inertia, vector)

    def turn_back(patch: Patch) -> Numerators:
        return [arb_poly(p) for p in patch.turn_back(motion.total)]

    def store(patch: Patch) -> Numerators:
        return _subtract(turn_back(patch), carry(patch.rate(1)))

    def push(patch: Patch) -> Numerators:
        across = cross(patch.rate(1), carry(patch.rate(1)))
        return [a + b for a, b in zip(carry(patch.rate(2)), across, strict=True)]

    def spin(patch: Patch) -> Numerators:
        across = cross(patch.rate(1), turn_back(patch))
        return [a + b for a, b in zip(carry(patch.rate(2)), across, strict=True)]

    if name == "momentum":
        return 1, store, total + most * piece.gross(1)
    if motion.wheels:
        return 2, spin, most * piece.gross(2) + 2 * total * piece.gross(1)
    return 2, push, most * (piece.gross(2) + 2 * piece.gross(1) ** 2)


def _subtract(a: Numerators, b: Numerators) -> Numerators:
    return [x - y for x, y in zip(a, b, strict=True)]
