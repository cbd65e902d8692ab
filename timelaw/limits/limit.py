"""The registry of limits, by the key they have in problem and law files."""

from collections.abc import Callable, Mapping

from timelaw.limits.rate import Rate

LIMITS: dict[str, Callable[[float], Rate]] = {
    "velocity": lambda bound: Rate("velocity", 1, bound),
    "acceleration": lambda bound: Rate("acceleration", 2, bound),
    "jerk": lambda bound: Rate("jerk", 3, bound),
}


def limits_of(given: Mapping[str, float]) -> tuple[Rate, ...]:
    """The limits that a problem or law file gives, in the order of the registry."""
    return tuple(make(given[name]) for name, make in LIMITS.items() if name in given)
