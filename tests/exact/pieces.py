"""Pieces of arcs in exact numbers: the angle and its rates, their extrema found once."""

from functools import lru_cache

from flint import arb, fmpq, fmpq_poly

from tests.exact.polynomials import enclose_norm, enclose_size, from_bernstein, integrate_square
from tests.exact.rational import read, read_all

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
