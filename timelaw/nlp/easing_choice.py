"""From what the problem file says of easings to the families to be tried."""

from collections.abc import Iterator

from timelaw.easing.family import DoubleSFamily, Family, PolynomialFamily, SplineFamily
from timelaw.problem import Problem

POLYNOMIAL_DEGREE = 9
INTERVALS = 50
WITHIN = 0.01  # of the physical limit, where the file does not say how near `auto` has to come
AUTO_DEGREES = (5, 7, 9, 11, 13, 17, 21)
AUTO_INTERVALS = (28, 50, 100, 200)


def choose_families(problem: Problem) -> Iterator[Family]:
    """The family that the file names, or for `auto` the candidates from the simplest on.

    What the file leaves open is the least that suits the continuity.
    """
    r, easing = problem.nodes.continuity, problem.easing
    spline_degree = max(3, r + 2 if r > 2 else r + 1)
    if easing.basis == "double-s":
        yield DoubleSFamily(r)
    elif easing.basis == "spline":
        yield SplineFamily(easing.degree or spline_degree, easing.intervals or INTERVALS, r)
    elif easing.basis == "polynomial":
        yield PolynomialFamily(easing.degree or max(POLYNOMIAL_DEGREE, 2 * r + 3), r)
    else:
        yield from (PolynomialFamily(degree, r) for degree in AUTO_DEGREES if degree >= 2 * r + 1)
        yield from (SplineFamily(spline_degree, intervals, r) for intervals in AUTO_INTERVALS)


def allowed_excess(problem: Problem) -> float:
    """How near to the physical limit is near enough: for a family that is named, any distance."""
    if problem.easing.basis != "auto":
        return float("inf")
    return problem.easing.within or WITHIN
