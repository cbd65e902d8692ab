"""Rational segments of a law document in exact numbers."""

from functools import cached_property
from itertools import pairwise

from flint import arb

from tests.exact.curves import Curve, Points, make_curve
from tests.exact.origins import Origin
from tests.exact.quaternions import measure_turn, normalise
from tests.exact.rational import read_all
from tests.exact.segments import Segment

MARGIN = 0.01


class RationalSegment(Segment):
    """The orientation is Q/|Q|, Q a quaternion polynomial on each piece."""

    moves = True
    curved = True
    vectors = ("start", "end")

    @cached_property
    def pieces(self) -> list[Curve]:
        """Its pieces."""
        return [
            make_curve(float(p["duration"]), _freeze(p["control"]), _freeze(p.get("points") or []))
            for p in self.data["pieces"]
        ]

    @cached_property
    def origins(self) -> list[Origin]:
        """The ways of the body's origin on them; none if it only turns."""
        return [Origin(piece) for piece in self.pieces if piece.points]

    def first(self, order: int) -> list:
        """The rate vector of that order at its first instant."""
        return self.pieces[0].first(order)

    def last(self, order: int) -> list:
        """The rate vector at its last instant."""
        return self.pieces[-1].last(order)

    def jumps(self, order: int) -> list[list]:
        """The jumps of the rate vector between its pieces."""
        return [
            [y - x for x, y in zip(a.last(order), b.first(order), strict=True)]
            for a, b in pairwise(self.pieces)
        ]

    def sum_rate(self, order: int) -> arb:
        """Σ h · mean of |rate|, and a hundredth more for who measures it in doubles."""
        return sum((piece.duration * piece.mean(order) for piece in self.pieces), arb(0)) * (1 + arb(MARGIN))

    def miss_start(self) -> arb:
        """How far [rad] from `start` it begins; q and -q are 2π apart."""
        return measure_turn(normalise(self.start), normalise(self.pieces[0].control[0]))

    def miss_end(self) -> arb:
        """Its own error [rad]: at its start, between its pieces, and at its end."""
        error = self.miss_start()
        for a, b in pairwise(self.pieces):
            error += measure_turn(normalise(a.control[-1]), normalise(b.control[0]))
        end = normalise(read_all(self.data["end"]))
        return error + measure_turn(normalise(self.pieces[-1].control[-1]), end)

    def find_undefined(self) -> list[str]:
        """P1, and P2: orientations that are none, for Q = 0."""
        return super().find_undefined() + [
            f"P2 there is no orientation where piece {number} of {self.place} is zero"
            for number, piece in enumerate(self.pieces)
            if piece.vanishes
        ]


def _freeze(points: list[list[float]]) -> Points:
    return tuple(tuple(map(float, point)) for point in points)
