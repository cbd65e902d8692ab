"""Rows on many legs at once: where each comes nearest to its bound, enclosed over all pieces together."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from timelaw.limits.row import BoundRow, Row
from timelaw.numerics.array import Array
from timelaw.numerics.extrema import enclose_stack
from timelaw.numerics.polynomial import PolynomialStack


@dataclass(frozen=True)
class RowPeak:
    """|g| of a row reaches `lower` at τ = `at` of a leg, and never exceeds `upper`, rounding included."""

    row: BoundRow
    lower: float
    upper: float
    at: float


class Pieces(Protocol):
    """Pieces of one form, those of a leg together: whose each is (g,), and from where to where in τ (g,)."""

    @property
    def leg(self) -> NDArray[np.int64]: ...  # noqa: D102
    @property
    def start(self) -> Array: ...  # noqa: D102
    @property
    def end(self) -> Array: ...  # noqa: D102

    def derivative(self, order: int) -> PolynomialStack:
        """The k-th time derivatives of the travelled angle."""
        ...


def enclose_rows(rows: Sequence[Sequence[Row]], forms: Sequence[Pieces]) -> list[list[RowPeak]]:
    """The peaks of each leg's rows, in their order; there is one, and every leg has a piece in some form."""
    numbers = np.cumsum([0, *map(len, rows)]).tolist()
    by_degree: dict[int, list[tuple[int, PolynomialStack, Array, Array]]] = defaultdict(list)
    for form in forms:
        rates = {order: form.derivative(order) for own in rows for row in own for order in row.orders}
        legs, begins = np.unique(form.leg, return_index=True)
        for leg, begin, end in zip(legs.tolist(), begins.tolist(), [*begins[1:], len(form.leg)], strict=True):
            here = slice(begin, end)
            own = {order: rate.take(here) for order, rate in rates.items()}
            for number, row in enumerate(rows[leg], numbers[leg]):
                value = row.value(own)
                by_degree[value.degree].append((number, value, form.start[here], form.end[here]))
    peaks = _take_highest(list(map(_enclose, by_degree.values())))
    found = [RowPeak(row, *peak) for row, peak in zip((r for own in rows for r in own), peaks, strict=True)]
    return [found[first:last] for first, last in pairwise(numbers)]


def _enclose(places: Sequence[tuple[int, PolynomialStack, Array, Array]]) -> Array:
    """Rows' numbers, lower and upper bounds and where (4, m), of polynomials of one degree."""
    values = PolynomialStack.join([value for _, value, _, _ in places])
    peaks = enclose_stack(values.control)
    start, end = (np.concatenate([place[k] for place in places]) for k in (2, 3))
    number = np.repeat([place[0] for place in places], [len(place[2]) for place in places])
    return np.stack([number, peaks.lower, peaks.upper + values.error, start + peaks.at * (end - start)])


def _take_highest(parts: Sequence[Array]) -> list[tuple[float, float, float]]:
    """Lower and upper bound and place of each row: the earliest of the highest of its pieces."""
    number, lower, upper, at = np.concatenate(parts, axis=1)
    order = np.lexsort((-at, lower, number))
    firsts = np.flatnonzero(np.diff(number[order], prepend=-1))
    tops = order[np.append(firsts[1:], len(order)) - 1]
    most = np.maximum.reduceat(upper[order], firsts)
    return list(zip(lower[tops].tolist(), most.tolist(), at[tops].tolist(), strict=True))
