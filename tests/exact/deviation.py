"""How far the body leaves the closed arc from `start` to `end` of a rational segment: the exact maximum.

Of the plane of the arc and of both ends p the part of Q in them is rational in Q: the cosine of half the angle
to the arc is the length of that part over |Q|, of the plane where Q (or -Q) lies over the arc, else of the
nearer end. All places where such a part has an extremum, or where another one counts, are looked at.
"""

from functools import lru_cache
from math import inf

from flint import arb, arb_poly, fmpq, fmpq_poly

from tests.exact.curves import Curve
from tests.exact.polynomials import find_real_roots
from tests.exact.rational import Vector, dot, largest, root


class ArcPart:
    """One piece over an arc: `sides`, not negative over the arc (or both not positive, of -Q), and `gaps`.

    The gaps are D less the squares of Q's part in the plane, and along both ends.
    """

    def __init__(self, curve: Curve, start: Vector, end: Vector):
        q = curve.parts
        along = [sum((x * p for x, p in zip(v, q, strict=True)), fmpq_poly([])) for v in (start, end)]
        a, b, both = dot(start, start), dot(end, end), dot(start, end)
        gram = a * b - both * both
        self.square = dot(q, q)
        ends = [p * p / size for p, size in zip(along, (a, b), strict=True)]
        plane = (b * along[0] ** 2 - 2 * both * along[0] * along[1] + a * along[1] ** 2) / (gram or fmpq(1))
        self.flat = not gram  # ends that are one: the arc is a point
        self.sides = [a * along[1] - both * along[0], b * along[0] - both * along[1]]
        self.gaps = [self.square - part for part in (ends[0] if self.flat else plane, *ends)]

    def measure(self, u: arb) -> arb:
        """sin² of half the angle to the arc at u; of a place on the border both are taken."""
        square = arb_poly(self.square)(u)
        plane, *ends = [arb_poly(gap)(u) / square for gap in self.gaps]
        beyond = ends[0].min(ends[1])
        if self.flat:
            return beyond
        first, last = (arb_poly(side)(u) for side in self.sides)
        if (first > 0 and last > 0) or (first < 0 and last < 0):
            return plane
        return beyond if first * last < 0 else plane.union(beyond)

    def list_places(self) -> list[arb]:
        """Where an extremum may be, the ends of the piece among them."""
        slope = self.square.derivative()
        turning = [gap.derivative() * self.square - gap * slope for gap in self.gaps]
        even = self.gaps[1] - self.gaps[2]
        found = [arb(0), arb(1)]
        for p in (*turning, *self.sides, even):
            found += [u for u in find_real_roots(p) if u > 0 and u < 1]
        return found


@lru_cache(maxsize=500)
def _measure(curve: Curve, start: tuple[fmpq, ...], end: tuple[fmpq, ...]) -> arb:
    part = ArcPart(curve, list(start), list(end))
    most = largest([part.measure(u) for u in part.list_places()])
    return 2 * arb.atan2(root(most), root(1 - most))


def measure_deviation(pieces: list[Curve], start: Vector, end: Vector) -> tuple[arb, float]:
    """The largest angle [rad] over all pieces, and what it would be if nothing cancelled.

    Infinite where Q may come over the other side of the circle: there -Q is meant, and a proof may say more.
    """
    found = largest([_measure(piece, tuple(start), tuple(end)) for piece in pieces])
    if dot(start, end) < 0 or not 2 * found < arb.pi():
        return found, inf
    sizes = [max(float(dot(p, p)) for p in piece.control) / piece.thinnest for piece in pieces]
    return found, 4 * max(sizes) ** 0.5
