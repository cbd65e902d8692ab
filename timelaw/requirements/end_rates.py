"""Rates with which the motion begins or ends moving: within the limits of the leg there, or refused."""

from collections.abc import Sequence

from timelaw.errors import Fault, InputError
from timelaw.limits import Demand, Row
from timelaw.limits.row import ORDERS

AT_LIMIT = 1e-12  # relative: what is typed as the limit itself may be rounded otherwise
EASED = (
    1e-11  # of time: how far a motion keeps from a limit that it starts at, far below what counts as a jump
)
KEYS = {order: name for name, order in ORDERS.items()}


def check_end_rates(end: str, rates: Sequence[float], demand: Demand) -> None:
    """Refuse rates φ', φ'', … at the `end` ("start" or "end") that break a limit of the leg there.

    Raises:
        InputError: with the key, the limit, and how many times as large the rate is.
    """
    for row in demand.rows:
        used = _used(row, rates)
        if used > 1 + AT_LIMIT:
            key = f".{KEYS[row.orders[0]]}" if len(row.orders) == 1 else ""
            times = f"{used:.6g}" if used > 1 + 1e-5 else f"{used:.12g}"
            message = f"{times} times as much as the limit on the {row.label} allows on the leg there"
            raise InputError(Fault(message, f"nodes.{end}{key}"))


def ease_end_rates(rates: Sequence[float], demand: Demand) -> tuple[float, ...]:
    """The rates, a motion 1 + 1e-11 times as slow where they are at a limit: nothing can be proved on it."""
    if all(_used(row, rates) < 1 - EASED for row in demand.rows):
        return tuple(rates)
    return tuple(rate / (1 + EASED) ** k for k, rate in enumerate(rates, 1))


def is_at_limit(row: Row, rates: Sequence[float], near: float) -> bool:
    """Whether the rates use more than 1 - `near` of what a row allows."""
    return _used(row, rates) > 1 - near


def _used(row: Row, rates: Sequence[float]) -> float:
    """The part of a row that the rates use; 0 where they do not say it."""
    if max(row.orders) > len(rates):
        return 0.0
    value = row.value({k: rates[k - 1] for k in row.orders})
    return float((abs(value) / row.bound) ** (1 / row.root))
