"""What an objective answers for: to the problem file, to the solver, and to whoever compares laws by it."""

from collections.abc import Sequence
from typing import Any, Protocol

from timelaw.easing import Timing
from timelaw.limits import Demand


class Terms(Protocol):
    """What a program offers an objective to be made of, each an expression of order one.

    `legs` is the number of legs, `weight` that of an effort against time, if it has one.
    """

    @property
    def legs(self) -> int: ...  # noqa: D102
    @property
    def weight(self) -> float | None: ...  # noqa: D102

    @property
    def elastic(self) -> bool:
        """Whether time may be stretched to the limits afterwards."""
        ...

    @property
    def scale(self) -> float:
        """The effort of the start; 0 where it has none."""
        ...

    @property
    def time(self) -> Any:
        """Total time in mean durations of a leg at the start."""
        ...

    @property
    def used_part(self) -> Any:
        """The variable by which all limits are scaled."""
        ...

    def effort(self, name: str) -> Any:
        """An effort relative to that of the start, where the start has one."""
        ...


class Objective(Protocol):
    """What is made least.

    `symbol` is what is measured, in `unit`; `words` are what people call it. `takes` are the keys of a
    problem file that say in what time it is made least, or against which weight; without any, time
    is what is made least. `continuity` is the least class C^k under which it is finite.
    """

    @property
    def name(self) -> str: ...  # noqa: D102
    @property
    def words(self) -> str: ...  # noqa: D102
    @property
    def symbol(self) -> str: ...  # noqa: D102
    @property
    def unit(self) -> str: ...  # noqa: D102
    @property
    def takes(self) -> tuple[str, ...]: ...  # noqa: D102
    @property
    def continuity(self) -> int: ...  # noqa: D102
    @property
    def needs_inertia(self) -> bool: ...  # noqa: D102

    @property
    def separable(self) -> bool:
        """Whether each run may be solved by itself, and time stretched to the limits at the end."""
        ...

    @property
    def scales_limits(self) -> bool:
        """Whether a variable that scales all limits is what is made least."""
        ...

    def measure(self, demands: Sequence[Demand], timings: Sequence[Timing]) -> float:
        """Its value for given timings of the legs."""
        ...

    def scale(self, demands: Sequence[Demand], start: Sequence[Timing]) -> float:
        """What efforts in the program are relative to: the size at its start."""
        ...

    def expression(self, terms: Terms) -> Any:
        """What the solver makes least."""
        ...
