"""Polynomials on patches of a piece: exact, with what rates, momenta and places are there over D = Q·Q."""

from collections.abc import Iterator
from functools import cached_property

from flint import arb, arb_poly, fmpq, fmpq_poly

from tests.exact.rational import cross, dot

FIRST = 3  # halvings at the start: 8 patches

Numerators = list[arb_poly]  # (3,)


class Patch:
    """Q and P over u = c + r v, v in [-1, 1]; t = h u, so that `width` h r is dt/dv."""

    def __init__(self, whole: "Patches", middle: fmpq, depth: int):
        self.middle, self.depth = middle, depth
        radius = fmpq(1, 2) ** (depth + 1)
        self.width = whole.duration * radius
        self.parts, self.points = (
            [p(fmpq_poly([middle, radius])) for p in own] for own in (whole.parts, whole.points)
        )
        self._rates: dict[int, Numerators] = {}
        self._places: dict[int, Numerators] = {}
        self._powers: dict[int, arb_poly] = {}

    @cached_property
    def square(self) -> fmpq_poly:
        """D."""
        return dot(self.parts, self.parts)

    def power(self, exponent: int) -> arb_poly:
        """D^exponent."""
        if exponent not in self._powers:
            half = exponent // 2
            self._powers[exponent] = (
                arb_poly(self.square) if exponent == 1 else self.power(half) * self.power(exponent - half)
            )
        return self._powers[exponent]

    def rate(self, order: int) -> Numerators:
        """X_k, of which the k-th rate is X_k/D^k in time: X_1 = 2 Vec(Q̄ Q'), X_(k+1) = X_k' D - k X_k D'."""
        if order not in self._rates:
            if order == 1:
                slopes = [p.derivative() for p in self.parts]
                made = [arb_poly(2 * p / self.width) for p in turn_vector(self.parts, slopes)]
            else:
                d, fall = self.power(1), arb_poly(self.square.derivative()) * (order - 1)
                scale = 1 / arb(self.width)
                made = [(x.derivative() * d - x * fall) * scale for x in self.rate(order - 1)]
            self._rates[order] = made
        return self._rates[order]

    def place(self, order: int) -> Numerators:
        """Y_k, of which the k-th derivative of P/D is Y_k/D^(k+1): Y_0 = P, Y_(k+1) = Y_k' D - (k+1) Y_k D'."""
        if order not in self._places:
            if order == 0:
                made = [arb_poly(p) for p in self.points]
            else:
                d, fall = self.power(1), arb_poly(self.square.derivative()) * order
                scale = 1 / arb(self.width)
                made = [(x.derivative() * d - x * fall) * scale for x in self.place(order - 1)]
            self._places[order] = made
        return self._places[order]

    def turn_back(self, vector: list[fmpq]) -> list[fmpq_poly]:
        """D times a vector of the world in body axes."""
        w, *v = self.parts
        # Rᵀ h for a quaternion of any norm: (w² - v·v) h + 2 (v·h) v - 2 w v × h
        along, across = dot(v, [fmpq_poly([x]) for x in vector]), cross(v, vector)
        plain = w * w - dot(v, v)
        return [plain * x + 2 * along * p - 2 * w * c for x, p, c in zip(vector, v, across, strict=True)]


def turn_vector(a: list, b: list) -> list:
    """Vec(ā b)."""
    across = cross(a[1:], b[1:])
    return [a[0] * b[i + 1] - b[0] * a[i + 1] - across[i] for i in range(3)]


class Patches:
    """The patches of one piece, made once; `points` are the components of P, none if it only turns."""

    def __init__(self, parts: list[fmpq_poly], points: list[fmpq_poly], duration: fmpq):
        self.parts, self.points, self.duration = parts, points, duration
        self.known: dict[tuple[fmpq, int], Patch] = {}

    def get(self, middle: fmpq, depth: int) -> Patch:
        """The one about `middle`, of the 2^depth-th part of the piece."""
        key = (middle, depth)
        if key not in self.known:
            self.known[key] = Patch(self, middle, depth)
        return self.known[key]

    def first(self) -> Iterator[Patch]:
        """Those to begin with."""
        count = 2**FIRST
        for i in range(count):
            yield self.get(fmpq(2 * i + 1, 2 * count), FIRST)

    def halve(self, patch: Patch) -> tuple[Patch, Patch]:
        """Both halves."""
        quarter = fmpq(1, 2) ** (patch.depth + 2)
        return tuple(self.get(patch.middle + side * quarter, patch.depth + 1) for side in (-1, 1))
