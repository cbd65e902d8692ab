"""What a limit provides, and what a file says of its kind."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from timelaw.limits.body import RigidBody
from timelaw.limits.bounds import Bounds
from timelaw.limits.formula import Formula, Rates, Vector
from timelaw.limits.row import Row
from timelaw.numerics.array import Array
from timelaw.units import Kind


class Limit(Protocol):
    """A bound on the body's motion; it answers for itself on a leg about a fixed axis."""

    @property
    def name(self) -> str:
        """Its key in files."""
        ...

    @property
    def power(self) -> int:
        """The k for which stretching time by c divides what is limited by c^k."""
        ...

    @property
    def depth(self) -> int:
        """On a rational segment what is limited is a polynomial over |Q|² to this power."""
        ...

    @property
    def highest(self) -> int:
        """The order of the highest rate of rotation that enters; 0 for none."""
        ...

    @property
    def unit(self) -> str:
        """Of what is limited, in SI."""
        ...

    @property
    def couples(self) -> bool:
        """Whether on a leg it ties rates of different orders together, so that no bound on one says all."""
        ...

    @property
    def bounds(self) -> Bounds:
        """On the norm of what is limited, or on its components."""
        ...

    def vector(self, rates: Rates, total: Vector = ...) -> Vector:
        """What is limited (3), in the vectors ω, α, …; `total` is the angular momentum H in body axes."""
        ...

    def of(self, rates: Rates, total: Vector = ...) -> Sequence[Formula]:
        """The limit as formulas: on the square of its vector's norm, or on each component."""
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

    `quantity` is its unit, `make` the limit from bounds and the body, whose inertia it needs or not; one that
    needs a translation has no meaning for a body that only turns.
    Continuity of class C^`continuity` is the least under which it can hold: where a rate jumps, the
    next one is unbounded. The fastest motion under it is of class C^`smooths`. One that is not `sufficient`
    bounds no motion by itself.
    `contradiction` says why a body can hold bounds at no time at all; empty if it can.
    """

    quantity: Kind
    make: Callable[[Bounds, RigidBody], Limit]
    needs_inertia: bool = False
    needs_translation: bool = False
    continuity: int = 1
    smooths: int = 0
    sufficient: bool = True
    contradiction: Callable[[Bounds, RigidBody], str] = lambda _, __: ""
