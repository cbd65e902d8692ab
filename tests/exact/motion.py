"""A law document's segments in exact numbers: what its arcs and dwells are, whatever is promised of them."""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

from flint import arb, fmpq, fmpq_poly

from tests.exact.polynomials import enclose_norm, enclose_size, from_bernstein, integrate_square
from tests.exact.rational import Vector, apply, cross, dot, largest, read, read_all, root

ORDERS = (1, 2, 3, 4)
RATES = {1: "omega", 2: "alpha", 3: "jerk", 4: "snap"}
KNOWN = 20000  # pieces whose extrema are kept: an altered law shares most of its pieces with the law


class Piece:
    """φ on [0, h]: `state` at its start, control points of the next derivative."""

    def __init__(self, duration: float, state: tuple[float, ...], control: tuple[float, ...]):
        self.duration = read(duration)
        self.known = read_all(state)
        self.top = from_bernstein(read_all(control))
        self.rates: dict[int, fmpq_poly] = {len(state): self.top}
        self.sizes: dict[int, arb] = {}
        self.rough = [abs(x) for x in self.known], max(abs(read(c)) for c in control)

    def rate(self, order: int) -> fmpq_poly:
        """φ^(order), over u = t/h in [0, 1]."""
        if order not in self.rates:
            if order < len(self.known):
                higher = self.rate(order + 1)
                self.rates[order] = fmpq_poly([self.known[order]]) + self.duration * higher.integral()
            else:
                self.rates[order] = self.rate(order - 1).derivative() / self.duration
        return self.rates[order]

    def first(self, order: int) -> fmpq:
        """φ^(order) at its start."""
        return self.rate(order)(fmpq(0))

    def last(self, order: int) -> fmpq:
        """φ^(order) at its end."""
        return self.rate(order)(fmpq(1))

    def size(self, order: int) -> arb:
        """max |φ^(order)|."""
        if order not in self.sizes:
            self.sizes[order] = enclose_size(self.rate(order))
        return self.sizes[order]

    def torque(self, a: fmpq, b: fmpq) -> arb:
        """max √(a φ''² + b φ'⁴)."""
        return enclose_norm(self.rate(1), self.rate(2), a, b, self.duration)

    def square(self, order: int) -> fmpq:
        """Mean of (φ^(order))²."""
        return integrate_square(self.rate(order))

    def gross(self, order: int) -> fmpq:
        """What |φ^(order)| is at most if nothing cancels: rounding is measured against it."""
        states, top = self.rough
        if order > len(states):
            return top * (2 * fmpq(max(self.top.degree(), 1)) / self.duration) ** (order - len(states))
        terms, factor = fmpq(0), fmpq(1)
        for step, value in enumerate([*states[order:], top], 1):
            terms += value * factor
            factor = factor * self.duration / step
        return terms


@lru_cache(maxsize=KNOWN)
def make_piece(duration: float, state: tuple[float, ...], control: tuple[float, ...]) -> Piece:
    """The piece of these numbers, its extrema found once."""
    return Piece(duration, state, control)


@dataclass
class Segment:
    """A segment of the document; a dwell has no pieces, and an axis of zeros."""

    data: dict[str, Any]
    index: int

    @cached_property
    def moves(self) -> bool:
        """Whether it is an arc."""
        return self.data["kind"] == "arc"

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

    @cached_property
    def pieces(self) -> list[Piece]:
        """Its pieces, none for a dwell."""
        return [
            make_piece(float(p["duration"]), tuple(map(float, p["state"])), tuple(map(float, p["bernstein"])))
            for p in self.data.get("pieces", [])
        ]

    @cached_property
    def axis(self) -> Vector:
        """The axis as it is stored."""
        return read_all(self.data["axis"]) if self.moves else [fmpq(0)] * 3

    @cached_property
    def squared_length(self) -> fmpq:
        """|axis|²; 1 for a dwell."""
        return dot(self.axis, self.axis) if self.moves else fmpq(1)

    @cached_property
    def length(self) -> arb:
        """|axis|."""
        return root(self.squared_length)

    @property
    def limits(self) -> dict[str, Any]:
        """Its own limits."""
        return self.data.get("limits", {}) if self.moves else {}

    def first(self, order: int) -> list[arb]:
        """The rate vector of that order at its first instant."""
        return [self.pieces[0].first(order) * a / self.length if self.pieces else arb(0) for a in self.axis]

    def last(self, order: int) -> list[arb]:
        """The rate vector at its last instant."""
        return [self.pieces[-1].last(order) * a / self.length if self.pieces else arb(0) for a in self.axis]

    def size(self, order: int) -> arb:
        """max |φ^(order)| over all pieces."""
        return largest([piece.size(order) for piece in self.pieces])

    def gross(self, order: int) -> fmpq:
        """The largest of the pieces'."""
        return max((piece.gross(order) for piece in self.pieces), default=fmpq(0))


class Motion:
    """The whole document: `segments`, `limits`, the body's inertia (3, 3) and the size of its momentum."""

    def __init__(self, document: dict[str, Any]):
        self.document = document
        self.segments = [Segment(data, index) for index, data in enumerate(document["segments"])]
        self.limits: dict[str, Any] = document["limits"]
        body = document.get("body") or {}
        self.inertia = [read_all(row) for row in body["inertia"]] if body else None
        self.wheels = body.get("actuator") == "wheels"
        self.momentum = read_all(body.get("momentum", [0, 0, 0]))

    @property
    def moving(self) -> list[Segment]:
        """The segments that turn the body."""
        return [segment for segment in self.segments if segment.moves]

    @property
    def end(self) -> fmpq:
        """The end of the last segment."""
        return self.segments[-1].begins + self.segments[-1].duration

    def outside(self, side: str, order: int) -> list[arb]:
        """The rate vector before or after the motion."""
        given = ((self.document.get("outside") or {}).get(side) or {}).get(RATES[order], [0, 0, 0])
        return [arb(x) for x in read_all(given)]

    def carry(self, segment: Segment) -> tuple[Vector, Vector]:
        """J a and a × J a of a segment's axis a as it is stored."""
        carried = apply(self.inertia, segment.axis)
        return carried, cross(segment.axis, carried)
