"""Pieces of rational segments in exact numbers: Q, not normalised, the rates of Q/|Q|, their extrema and means."""

from collections.abc import Hashable
from functools import cached_property, lru_cache
from itertools import pairwise
from math import comb

from flint import arb, arb_poly, ctx, fmpq, fmpq_poly

from tests.exact.patches import Patches, turn_vector
from tests.exact.polynomials import find_real_roots, from_bernstein
from tests.exact.quadrature import integrate
from tests.exact.quotients import Quotient, enclose_quotient
from tests.exact.rational import Vector, dot, norm, read, read_all, root

KNOWN = 2000  # pieces that are kept with their extrema
ORDERS = (1, 2, 3, 4)
HIGHEST = 5  # derivative of Q
CURVE_PRECISION = 640  # bits; powers of D lose more than angles do
MEAN_PRECISION = 160  # bits, of a mean that jumps are judged by

Points = tuple[tuple[float, ...], ...]


class Curve:
    """Q over `duration` h [s] by its control points (d+1, 4), and P by its points (m+1, 3) if the body moves."""

    def __init__(self, duration: float, control: Points, points: Points = ()):
        self.duration = read(duration)
        self.control, self.points = ([read_all(point) for point in given] for given in (control, points))
        self.parts, self.path = (
            [from_bernstein(list(column)) for column in zip(*given, strict=True)]
            for given in (self.control, self.points)
        )
        self.patches = Patches(self.parts, self.path, self.duration)
        self._known: dict[Hashable, arb] = {}

    @cached_property
    def vanishes(self) -> bool:
        """Whether Q = 0 somewhere, which is where all its components have a root in common."""
        common = fmpq_poly([])
        for p in self.parts:
            common = common.gcd(p)
        if common.is_zero():
            return True
        if common(fmpq(0)) == 0 or common(fmpq(1)) == 0:
            return True
        return any(not (place < 0 or place > 1) for place in find_real_roots(common))

    def rates_at(self, u: int) -> dict[int, Vector]:
        """ω, α, jerk, snap at u = 0 or 1 by order, rational: the derivatives of N = ω D by Leibniz' rule."""
        q = [[p(fmpq(u)) for p in self.derivatives[k]] for k in range(6)]
        return solve_rates(q)

    @cached_property
    def derivatives(self) -> list[list[fmpq_poly]]:
        """Q and its derivatives in time."""
        return derive(self.parts, self.duration)

    @cached_property
    def _ends(self) -> tuple[dict[int, Vector], dict[int, Vector]]:
        return self.rates_at(0), self.rates_at(1)

    def first(self, order: int) -> Vector:
        """The rate vector at its start."""
        return self._ends[0][order]

    def last(self, order: int) -> Vector:
        """The rate vector at its end."""
        return self._ends[1][order]

    def enclose(self, key: Hashable, quotient: Quotient, *, squared: bool, gross: float) -> arb:
        """The largest |p|/q, or its root; kept by a key."""
        if key not in self._known:
            with ctx.workprec(CURVE_PRECISION):
                size = arb(gross) ** (2 if squared else 1)
                found = enclose_quotient(self.patches, quotient, (1,) if squared else (1, -1), size)
                self._known[key] = root(found) if squared else found
        return self._known[key]

    def size(self, order: int) -> arb:
        """max |rate|."""

        def square(patch):
            rate = patch.rate(order)
            return dot(rate, rate), patch.power(2 * order)

        return self.enclose(("size", order), square, squared=True, gross=self.gross(order))

    def mean(self, order: int) -> arb:
        """Mean of |rate|, by quadrature: it is what jumps are measured by."""
        return self._means[order - 1]

    @cached_property
    def _means(self) -> list[arb]:
        with ctx.workprec(MEAN_PRECISION):
            made = [[arb_poly(p) for p in parts] for parts in self.derivatives[: len(ORDERS) + 1]]

            def sizes(u: arb) -> list[arb]:
                rates = solve_rates([[p(u) for p in parts] for parts in made])
                return [norm(rates[k]) for k in ORDERS]

            return integrate(sizes)

    @cached_property
    def thinnest(self) -> float:
        """min D."""
        one = arb_poly([1])
        most = self.enclose("thin", lambda patch: (one, patch.power(1)), squared=False, gross=1.0)
        return float(1 / most)

    def gross(self, order: int) -> float:
        """What |rate| is at most if nothing cancels: Leibniz' rule with sizes alone."""
        sizes = list_sizes(self.control, self.duration, order)
        rates: list[float] = []
        for k in range(order):
            total = sum(2 * comb(k, i) * sizes[i] * sizes[k - i + 1] for i in range(k + 1))
            for i, lower in enumerate(rates):
                fall = sum(comb(k - i, j) * sizes[j] * sizes[k - i - j] for j in range(k - i + 1))
                total += comb(k, i) * lower * fall
            rates.append(total / self.thinnest)
        return rates[-1]


def list_sizes(points: list[Vector], duration: fmpq, order: int) -> list[float]:
    """What a curve and its first derivatives are at most, by differences of its control points."""
    sizes = []
    for _ in range(order + 1):
        sizes.append(max(float(dot(p, p)) for p in points) ** 0.5)
        factor = (len(points) - 1) / duration
        points = [[(b - a) * factor for a, b in zip(*two, strict=True)] for two in pairwise(points)] or [
            [fmpq(0)] * len(points[0])
        ]
    return sizes


def derive(parts: list[fmpq_poly], duration: fmpq) -> list[list[fmpq_poly]]:
    """Polynomials over u = t/h and their derivatives in time."""
    made = [parts]
    for _ in range(HIGHEST):
        made.append([p.derivative() / duration for p in made[-1]])
    return made


def solve_rates(q: list[list]) -> dict[int, list]:
    """ω and its derivatives from Q and its, numbers of any kind."""
    zero = q[0][0] * 0
    rates: dict[int, list] = {}
    squares = [sum((comb(k, i) * dot(q[i], q[k - i]) for i in range(k + 1)), zero) for k in range(len(q) - 1)]
    for k in range(len(q) - 1):
        terms = [[comb(k, i) * x for x in turn_vector(q[i], q[k - i + 1])] for i in range(k + 1)]
        rate = [2 * sum(parts, zero) for parts in zip(*terms, strict=True)]
        for i in range(k):
            rate = [a - comb(k, i) * b * squares[k - i] for a, b in zip(rate, rates[i + 1], strict=True)]
        rates[k + 1] = [x / squares[0] for x in rate]
    return rates


@lru_cache(maxsize=KNOWN)
def make_curve(duration: float, control: Points, points: Points = ()) -> Curve:
    """The piece of these numbers, its extrema found once."""
    return Curve(duration, control, points)
