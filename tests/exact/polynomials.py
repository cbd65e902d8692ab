"""Polynomials over [0, 1] with rational coefficients, and the largest size they reach there."""

from collections.abc import Sequence
from itertools import pairwise
from math import comb

from flint import arb, arb_poly, ctx, fmpq, fmpq_poly

from tests.exact.rational import PRECISION, Vector, root

LOST = 6  # bits for each degree: powers cancel where control points do not


def from_bernstein(control: Vector) -> fmpq_poly:
    """The polynomial of control points: its i-th coefficient is C(n, i) Δ^i c_0."""
    coefficients, differences = [], list(control)
    for i in range(len(control)):
        coefficients.append(comb(len(control) - 1, i) * differences[0])
        differences = [b - a for a, b in pairwise(differences)]
    return fmpq_poly(coefficients)


def integrate_square(p: fmpq_poly) -> fmpq:
    """∫ p² over [0, 1]."""
    return (p * p).integral()(fmpq(1))


def enclose_size(p: fmpq_poly, factors: Sequence[fmpq_poly] | None = None) -> arb:
    """max |p| over [0, 1], a ball; `factors` of p' may be given where they are known.

    All roots of p' are isolated, so none is missed. Where one is not surely inside, the ball is widened
    to hold both its value and that of the end of the interval: its lower end never exceeds the maximum.
    """
    ends = abs(p(fmpq(0))), abs(p(fmpq(1)))
    best = arb(max(ends))
    if p.degree() < 1:
        return best
    with ctx.workprec(PRECISION + LOST * p.degree()):
        for factor in [p.derivative()] if factors is None else factors:
            for point in find_real_roots(factor):
                if not (point < 0 or point > 1):
                    best = best.max(_evaluate(p, point, ends))
    return best


def _evaluate(p: fmpq_poly, point: arb, ends: tuple[fmpq, fmpq]) -> arb:
    """|p| at a root of p'."""
    value = abs(arb_poly(p)(point))
    if not point > 0:
        value = value.union(arb(ends[0]))
    if not point < 1:
        value = value.union(arb(ends[1]))
    return value


def find_real_roots(p: fmpq_poly) -> list[arb]:
    """Balls about the real roots; those of multiplicity once each."""
    if p.degree() < 1:
        return []
    if p.degree() == 1:
        return [arb(-p[0] / p[1])]
    return [place.real for place, _ in p.complex_roots() if place.imag.is_zero()]


def enclose_norm(first: fmpq_poly, second: fmpq_poly, a: fmpq, b: fmpq, width: fmpq) -> arb:
    """√max(a φ''² + b φ'⁴) of φ' and φ'' on a piece that lasts `width`; a, b ≥ 0.

    The derivative is 2 φ'' (a φ''' + 2 b φ'³), whose factors are of lower degree.
    """
    square = first * first
    rest = a * second.derivative() / width + 2 * b * square * first
    value = a * second * second + b * square * square
    return root(enclose_size(value, [second, rest]))
