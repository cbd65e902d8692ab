"""The registry of limits, by the key they have in problem and law files."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from timelaw.limits.momentum import Momentum
from timelaw.limits.rate import Rate
from timelaw.limits.row import RateRow, Row
from timelaw.limits.torque import Torque
from timelaw.numerics.array import Array
from timelaw.problem.body import Bounds


class Limit(Protocol):
    """What a limit provides: its rows on a leg about a given axis."""

    def on(self, axis: Array) -> tuple[Row, ...]:
        """Rows on a leg about `axis` (3,)."""
        ...


LIMITS: dict[str, Callable[[Bounds, Any], Limit]] = {
    "velocity": lambda bounds, _: Rate("velocity", 1, bounds),
    "acceleration": lambda bounds, _: Rate("acceleration", 2, bounds),
    "jerk": lambda bounds, _: Rate("jerk", 3, bounds),
    "snap": lambda bounds, _: Rate("snap", 4, bounds),
    "torque": lambda bounds, inertia: Torque("torque", bounds, inertia),
    "momentum": lambda bounds, inertia: Momentum("momentum", bounds, inertia),
}


def limits_of(given: Mapping[str, Bounds], inertia: Array | None = None) -> tuple[Limit, ...]:
    """The limits that a problem or law file gives, in the order of the registry."""
    return tuple(make(given[name], inertia) for name, make in LIMITS.items() if name in given)


def rows_on(limits: Sequence[Limit], axis: Array) -> tuple[Row, ...]:
    """All rows of the limits on a leg about `axis`."""
    return tuple(row for limit in limits for row in limit.on(axis))


def binding(rows: Sequence[Row]) -> tuple[Row, ...]:
    """The rows without those that another of the same form always implies, or that are always zero."""
    kept: list[Row] = []
    tightest: dict[int, RateRow] = {}
    for row in rows:
        if not isinstance(row, RateRow):
            kept.append(row)
        elif row.effective() < tightest.get(row.order, _UNBOUNDED).effective():
            tightest[row.order] = row
    return (*(tightest[order] for order in sorted(tightest)), *kept)


_UNBOUNDED = RateRow("", "", "", 0, 0.0, 1.0)
