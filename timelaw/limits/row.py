"""Rows: what a limit demands on one leg, a bound on a polynomial in the rates of the angle.

Along a leg the axis n stays the same in the body, so each limit becomes |g(φ', φ'', …)| ≤ bound at
every instant, g a polynomial. `rates[k]` is the k-th time derivative of the angle in whatever
form: symbols of the solver, polynomials in time, or arrays of numbers. The row's own coefficients are
floats, or balls where the leg's axis is given so: that is what a proof needs.

Stretching time by c divides g by c^power where the row is homogeneous, else its terms by the least to
the greatest of `powers`; `root` says that g is the root-th power of the limited quantity (2 for norms
of vectors), so the fraction of the limit used is (|g|/bound)^(1/root). `limit` is the key a row comes
from, `label` names the axis too; `coefficients` tell rows of one label apart; a `note` says where a
row demands more than the limit itself.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any, ClassVar, Protocol

ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3, "snap": 4}  # of the limited rates


class BoundRow(Protocol):
    """What proofs and pictures ask of a row: |g| ≤ bound, g the root-th power of what is limited."""

    @property
    def limit(self) -> str: ...  # noqa: D102
    @property
    def label(self) -> str: ...  # noqa: D102
    @property
    def unit(self) -> str: ...  # noqa: D102
    @property
    def bound(self) -> float: ...  # noqa: D102
    @property
    def orders(self) -> tuple[int, ...]:
        """Orders of the rates that enter."""
        ...

    @property
    def note(self) -> str: ...  # noqa: D102

    @property
    def root(self) -> int:
        """Of the limited quantity that g is a power of."""
        ...

    def size(self, value: float) -> float:
        """The limited quantity, if |g| is this."""
        ...

    def rate_bound(self, order: int) -> float:
        """The bound on the size of that rate itself that the row is; infinite where it is none."""
        ...


class Row(BoundRow, Protocol):
    """What the solver and closed forms ask besides; no code asks what class it is of."""

    @property
    def powers(self) -> tuple[int, ...]:
        """Of the time by which the terms of |g| fall when time is stretched; one for a homogeneous row."""
        ...

    @property
    def couples(self) -> bool:
        """Whether it ties rates of different orders together."""
        ...

    def value(self, rates: Mapping[int, Any]) -> Any:
        """The polynomial g."""
        ...

    def coefficients(self) -> tuple[float, ...]:
        """Numbers that tell rows of one label apart."""
        ...

    def speed_limit(self) -> float:
        """The largest |φ'| that can be kept, φ'' being zero; infinite where nothing bounds it."""
        ...

    def acceleration_limits(self, v: float) -> tuple[float, float]:
        """The largest φ'' and the largest -φ'' at φ' = v; infinite for no bound."""
        ...


@dataclass(frozen=True)
class RateRow:
    """|factor φ^(order)| ≤ bound; the limited quantity is larger by a constant `offset`."""

    limit: str
    label: str
    unit: str
    order: int
    factor: Any
    bound: float
    offset: float = 0.0
    note: str = ""
    root: ClassVar[int] = 1
    couples: ClassVar[bool] = False

    @property
    def orders(self) -> tuple[int, ...]:
        """The one order."""
        return (self.order,)

    @property
    def powers(self) -> tuple[int, ...]:
        """Time scaling: the order itself."""
        return (self.order,)

    def value(self, rates: Mapping[int, Any]) -> Any:
        """Factor times the rate."""
        rate = rates[self.order]
        return rate if self.factor == 1 else self.factor * rate

    def size(self, value: float) -> float:
        """What is limited."""
        return value + self.offset

    def coefficients(self) -> tuple[float, ...]:
        """Factor and bound."""
        return (self.factor, self.bound)

    def rate_bound(self, order: int) -> float:
        """Bound over factor; infinite for other orders, and where the axis has no such component."""
        return self.bound / abs(float(self.factor)) if self.factor and order == self.order else inf

    def speed_limit(self) -> float:
        """The bound, if it is one on φ'."""
        return self.rate_bound(1)

    def acceleration_limits(self, v: float) -> tuple[float, float]:  # noqa: ARG002
        """The bound on both sides, if it is one on φ''."""
        return self.rate_bound(2), self.rate_bound(2)


@dataclass(frozen=True)
class FormulaRow:
    """A limit's formula in the vectors ω, α, …, the `highest` rate in it of that order, for a proof.

    |g| ≤ `bound` where g is the `root`-th power of what the `label` names.
    """

    limit: str
    label: str
    unit: str
    bound: float
    root: int
    highest: int
    note: str = ""

    @property
    def orders(self) -> tuple[int, ...]:
        """The highest rate says what must not jump."""
        return (self.highest,)

    def size(self, value: float) -> float:
        """The limited quantity, if |g| is this."""
        return float(value ** (1 / self.root))

    def rate_bound(self, order: int) -> float:
        """Of a norm of that rate."""
        plain = self.root == 2 and ORDERS.get(self.limit) == order
        return self.size(self.bound) if plain else inf


def drop_implied(rows: Sequence[Row]) -> tuple[Row, ...]:
    """The rows without those that another bound on the same rate implies, or that are always zero."""
    kept: list[Row] = []
    tightest: dict[int, Row] = {}
    for row in rows:
        if row.couples:
            kept.append(row)
            continue
        (order,) = row.orders
        known = tightest[order].rate_bound(order) if order in tightest else inf
        if row.rate_bound(order) < known:
            tightest[order] = row
    return (*(tightest[order] for order in sorted(tightest)), *kept)
