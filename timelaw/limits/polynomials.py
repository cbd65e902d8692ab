"""Rows on a leg that is run through in a given way: polynomials in time, with their rounding."""

from collections.abc import Callable, Iterator, Sequence

from timelaw.limits.row import Row
from timelaw.numerics.polynomial import Polynomial


def expand_rows(
    rows: Sequence[Row], rates: Callable[[int], Sequence[Polynomial]]
) -> Iterator[tuple[Row, int, Polynomial]]:
    """Each row on each interval of a leg, as a polynomial in time; `rates(k)` lists the k-th rate's."""
    known = {order: rates(order) for order in {order for row in rows for order in row.orders}}
    for row in rows:
        for piece in range(len(known[row.orders[0]])):
            yield row, piece, row.value({order: known[order][piece] for order in row.orders})
