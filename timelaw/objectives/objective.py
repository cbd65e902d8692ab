"""The registry of objectives, by the key they have in problem files."""

from collections.abc import Callable
from typing import Any

Objective = Callable[[list[Any]], Any]


def total_time(durations: list[Any]) -> Any:
    """Σ T_k of the legs' durations, numbers or symbols of the solver."""
    return sum(durations[1:], start=durations[0])


OBJECTIVES: dict[str, Objective] = {"time": total_time}
