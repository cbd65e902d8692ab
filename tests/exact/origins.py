"""The body's origin on a piece of a rational segment: c = P/D, its derivatives in the world, their extrema."""

from functools import cached_property
from math import comb

from flint import arb, arb_poly, ctx, fmpq

from tests.exact.curves import MEAN_PRECISION, Curve, derive, list_sizes
from tests.exact.patches import Patch
from tests.exact.quadrature import integrate
from tests.exact.rational import Vector, dot, norm

HIGHEST = 4  # derivative of the place
ORDERS = tuple(range(1, HIGHEST + 1))
NORM = -1  # instead of the number of an axis


class Origin:
    """P/|Q|² on one piece."""

    def __init__(self, curve: Curve):
        self.curve = curve

    def places_at(self, u: int) -> list[Vector]:
        """The place and its derivatives at u = 0 or 1, rational."""
        at = fmpq(u)
        p, q = (
            [[part(at) for part in parts] for parts in derived[: HIGHEST + 1]]
            for derived in (self._derivatives, self.curve.derivatives)
        )
        return solve_places(p, q)

    @cached_property
    def _derivatives(self) -> list:
        return derive(self.curve.path, self.curve.duration)

    @cached_property
    def first(self) -> list[Vector]:
        """The place and its derivatives at its start."""
        return self.places_at(0)

    @cached_property
    def last(self) -> list[Vector]:
        """At its end."""
        return self.places_at(1)

    def measure(self, order: int, axis: int) -> arb:
        """The largest |k-th derivative|, or of one component."""

        def quotient(patch: Patch) -> tuple[arb_poly, arb_poly]:
            vector = patch.place(order)
            if axis == NORM:
                return dot(vector, vector), patch.power(2 * order + 2)
            return vector[axis], patch.power(order + 1)

        key = ("place", order, axis)
        return self.curve.enclose(key, quotient, squared=axis == NORM, gross=self.gross(order))

    @cached_property
    def means(self) -> list[arb]:
        """Means of the sizes of the derivatives, from the first on, by quadrature."""
        with ctx.workprec(MEAN_PRECISION):
            p, q = (
                [[arb_poly(part) for part in parts] for parts in derived[: HIGHEST + 1]]
                for derived in (self._derivatives, self.curve.derivatives)
            )

            def sizes(u: arb) -> list[arb]:
                values = ([[part(u) for part in parts] for parts in derived] for derived in (p, q))
                return [norm(rate) for rate in solve_places(*values)[1:]]

            return integrate(sizes)

    def gross(self, order: int) -> float:
        """What |k-th derivative| is at most if nothing cancels."""
        curve = self.curve
        sizes = list_sizes(curve.points, curve.duration, order)
        turns = list_sizes(curve.control, curve.duration, order)
        squares = [sum(comb(j, i) * turns[i] * turns[j - i] for i in range(j + 1)) for j in range(order + 1)]
        places: list[float] = []
        for k in range(order + 1):
            total = sizes[k] + sum(comb(k, i) * lower * squares[k - i] for i, lower in enumerate(places))
            places.append(total / curve.thinnest)
        return places[-1]


def solve_places(p: list[list], q: list[list]) -> list[list]:
    """c and its derivatives from those of P = c D and Q, numbers of any kind."""
    zero = q[0][0] * 0
    squares = [sum((comb(k, i) * dot(q[i], q[k - i]) for i in range(k + 1)), zero) for k in range(len(q))]
    places: list[list] = []
    for k, value in enumerate(p):
        for i, lower in enumerate(places):
            value = [a - comb(k, i) * b * squares[k - i] for a, b in zip(value, lower, strict=True)]
        places.append([x / squares[0] for x in value])
    return places
