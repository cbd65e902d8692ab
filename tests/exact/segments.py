"""Segments of a law document in exact numbers: what its arcs and dwells are, whatever is promised of them."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, ClassVar

from flint import arb, fmpq

from tests.exact.pieces import Piece, make_piece
from tests.exact.quaternions import measure_turn, multiply, normalise
from tests.exact.rational import Vector, dot, largest, read, read_all, root

ORDERS = (1, 2, 3, 4)


@dataclass
class Segment:
    """What segments of every kind have; of one without pieces that rests."""

    data: dict[str, Any]
    index: int
    moves: ClassVar[bool] = False
    curved: ClassVar[bool] = False
    vectors: ClassVar[Sequence[str]] = ("orientation",)  # keys of what has to be of length 1
    pieces: ClassVar[Sequence[Any]] = ()

    @property
    def name(self) -> str:
        """As certificates name it."""
        return f"{self.origin}–{self.target}" if self.moves else f"dwell at {self.origin}"

    @property
    def place(self) -> str:
        """How findings name it."""
        return f"segment {self.index} ({self.name})"

    @property
    def origin(self) -> str:
        """Label where it begins."""
        return self.data["from"] if self.moves else self.data["at"]

    @property
    def target(self) -> str:
        """Label where it ends."""
        return self.data["to"] if self.moves else self.data["at"]

    @cached_property
    def begins(self) -> fmpq:
        """`start_time`."""
        return read(self.data["start_time"])

    @cached_property
    def duration(self) -> fmpq:
        """`duration`."""
        return read(self.data["duration"])

    @property
    def start(self) -> Vector:
        """The orientation that it is said to start in, of any length."""
        return read_all(self.data["start" if self.moves else "orientation"])

    @property
    def limits(self) -> dict[str, Any]:
        """Its own limits."""
        return self.data.get("limits", {}) if self.moves else {}

    def first(self, order: int) -> list[arb]:  # noqa: ARG002
        """The rate vector of that order at its first instant."""
        return [arb(0)] * 3

    def last(self, order: int) -> list[arb]:
        """The rate vector at its last instant."""
        return self.first(order)

    def jumps(self, order: int) -> list[list]:  # noqa: ARG002
        """The jumps of the rate vector between its pieces."""
        return []

    def size(self, order: int) -> arb:
        """The largest |rate| of that order over all pieces."""
        return largest([piece.size(order) for piece in self.pieces])

    def gross(self, order: int) -> float:
        """What that would be if nothing cancelled."""
        return max((float(piece.gross(order)) for piece in self.pieces), default=0.0)

    def sum_rate(self, order: int) -> arb:
        """Σ h √(mean of |rate|² on the piece)."""
        return sum((piece.duration * root(piece.square(order)) for piece in self.pieces), arb(0))

    def find_undefined(self) -> list[str]:
        """P1: vectors of length zero, of which nothing else can be said."""
        return [f"P1 {key} of {self.place} is zero" for key in self.vectors if not any(self.data[key])]


class Arc(Segment):
    """A turn about one axis."""

    moves = True
    vectors = ("start", "end", "axis")

    @cached_property
    def pieces(self) -> list[Piece]:
        """Its pieces."""
        return [
            make_piece(float(p["duration"]), tuple(map(float, p["state"])), tuple(map(float, p["bernstein"])))
            for p in self.data["pieces"]
        ]

    @cached_property
    def axis(self) -> Vector:
        """The axis as it is stored."""
        return read_all(self.data["axis"])

    @cached_property
    def squared_length(self) -> fmpq:
        """|axis|²."""
        return dot(self.axis, self.axis)

    @cached_property
    def length(self) -> arb:
        """|axis|."""
        return root(self.squared_length)

    def _along(self, rate: fmpq) -> list[arb]:
        return [rate * a / self.length for a in self.axis]

    def first(self, order: int) -> list[arb]:
        """The rate vector of that order at its first instant."""
        return self._along(self.pieces[0].first(order))

    def last(self, order: int) -> list[arb]:
        """The rate vector at its last instant."""
        return self._along(self.pieces[-1].last(order))

    def jumps(self, order: int) -> list[list]:
        """The jumps of the rate vector between its pieces."""
        return [self._along(b.first(order) - a.last(order)) for a, b in pairwise(self.pieces)]

    def miss_start(self) -> arb:
        """How far [rad] from `start` it begins."""
        return arb(abs(self.pieces[0].first(0)))

    def miss_end(self) -> arb:
        """Its own error [rad]: at its start, between its pieces, at its end, and from its angle to `end`."""
        pieces = self.pieces
        own = self.miss_start() + abs(pieces[-1].last(0) - read(self.data["angle"]))
        own += sum((abs(b.first(0) - a.last(0)) for a, b in pairwise(pieces)), arb(0))
        return own + measure_turn(self._lead(), normalise(read_all(self.data["end"])))

    def _lead(self) -> list[arb]:
        """Where start, axis and angle lead."""
        half = arb(read(self.data["angle"])) / 2
        turned = [half.cos(), *(half.sin() * x for x in normalise(self.axis))]
        return multiply(normalise(self.start), turned)
