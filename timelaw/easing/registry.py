"""The registry of easings, by the basis that problem files name."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import inf
from typing import Protocol

from timelaw.easing.family import DoubleSFamily, Family, PolynomialFamily, SplineFamily

MAX_DEGREE = 31
POLYNOMIAL_DEGREE = 9
INTERVALS = 50
WITHIN = 0.01  # of the physical limit, where the file does not say how near `auto` has to come
AUTO_DEGREES = (9, 13, 21, 31)
AUTO_INTERVALS = (20, 28, 50, 100, 200)


class Settings(Protocol):
    """What a problem file says of its easing; None for what it leaves open."""

    @property
    def degree(self) -> int | None: ...  # noqa: D102
    @property
    def intervals(self) -> int | None: ...  # noqa: D102
    @property
    def within(self) -> float | None: ...  # noqa: D102


@dataclass(frozen=True)
class BasisKind:
    """One basis: the keys that belong to it, its degrees, and the families that it stands for.

    `families(settings, r)` gives those to be tried for continuity r, what the file leaves open being
    the least that suits r. `least_degree(r)` is the least that carries continuity r, and so is
    `least_intervals(settings, r)`: of fewer, both ends ask for more coefficients than there are. A basis in
    `pieces` of degree p jumps inside in its p-th derivative; a `rigid` one has nothing to choose.
    """

    families: Callable[[Settings, int], Iterator[Family]]
    keys: tuple[str, ...] = ()
    degrees: tuple[int, int] = (0, MAX_DEGREE)
    least_degree: Callable[[int], int] = lambda r: 2 * r + 1
    least_intervals: Callable[[Settings, int], int] = lambda _, __: 1
    pieces: bool = False
    rigid: bool = False
    searched: bool = False

    def allowed_excess(self, settings: Settings) -> float:
        """How near to the physical limit is near enough: for a family that is named, any distance."""
        return (settings.within or WITHIN) if self.searched else inf


def _polynomial(settings: Settings, r: int) -> Iterator[Family]:
    yield PolynomialFamily(settings.degree or max(POLYNOMIAL_DEGREE, 2 * r + 3), r)


def spline_degree(r: int) -> int:
    """The least for continuity r that leaves the spline at least as smooth inside."""
    return max(3, r + 2 if r > 2 else r + 1)


def _spline(settings: Settings, r: int) -> Iterator[Family]:
    yield SplineFamily(settings.degree or spline_degree(r), settings.intervals or INTERVALS, r)


def _least_intervals(settings: Settings, r: int) -> int:
    """N of the n + p coefficients, r + 1 of which each end takes."""
    return max(1, 2 * (r + 1) - (settings.degree or spline_degree(r)))


def _double_s(_: Settings, r: int) -> Iterator[Family]:
    yield DoubleSFamily(r)


def _auto(_: Settings, r: int) -> Iterator[Family]:
    """Candidates whose jerk does not jump inside a leg, from the cheapest on."""
    yield from (PolynomialFamily(degree, r) for degree in AUTO_DEGREES if degree >= 2 * r + 3)
    yield from (SplineFamily(max(4, spline_degree(r)), intervals, r) for intervals in AUTO_INTERVALS)


BASES: dict[str, BasisKind] = {
    "polynomial": BasisKind(_polynomial, ("degree",), (5, MAX_DEGREE)),
    "spline": BasisKind(
        _spline, ("degree", "intervals"), (3, 7), lambda r: r + 1, _least_intervals, pieces=True
    ),
    "double-s": BasisKind(_double_s, rigid=True),
    "auto": BasisKind(_auto, ("within",), searched=True),
}
