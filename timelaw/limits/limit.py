"""What a limit provides, and what a file says of its kind."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from timelaw.limits.bounds import Bounds
from timelaw.limits.row import Row
from timelaw.numerics.array import Array
from timelaw.units import Kind


class Limit(Protocol):
    """A bound on the body's motion; it answers for itself on a leg about a fixed axis."""

    @property
    def couples(self) -> bool:
        """Whether on a leg it ties rates of different orders together, so that no bound on one says all."""
        ...

    def on(self, axis: Array) -> Sequence[Row]:
        """Rows on a leg about `axis` (3,)."""
        ...

    def bound_rates(self, axes: Array) -> Mapping[int, Array]:
        """Bounds (...) on |d^k φ/dt^k| itself, by order k, for legs about many axes (..., 3)."""
        ...


@dataclass(frozen=True)
class LimitKind:
    """One key of the `limits` of problem and law files.

    `quantity` is its unit, `make` the limit from bounds and inertia J (3, 3), which it `needs_inertia`
    for or not. Continuity of class C^`continuity` is the least under which it can hold: where a rate
    jumps, the next one is unbounded. One that is not `sufficient` bounds no motion by itself.
    """

    quantity: Kind
    make: Callable[[Bounds, Array], Limit]
    needs_inertia: bool = False
    continuity: int = 1
    sufficient: bool = True
