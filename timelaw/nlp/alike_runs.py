"""Alike runs as one: what is asked of them is the same, so they are moved through alike."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from timelaw.nlp.program import Program
from timelaw.requirements.given_times import Budget

T = TypeVar("T")


@dataclass(frozen=True)
class AlikeRuns:
    """A program of the distinct runs, and which of them each run of the whole program is."""

    program: Program
    of_run: tuple[int, ...]

    def pick(self, legs: Sequence[T]) -> tuple[T, ...]:
        """Of something for each leg of the whole program what is first there for each distinct leg."""
        found: dict[int, tuple[T, ...]] = {}
        passed = 0
        for index in self.of_run:
            count = len(self.program.runs[index].demands)
            found.setdefault(index, tuple(legs[passed : passed + count]))
            passed += count
        return tuple(leg for index in range(len(self.program.runs)) for leg in found[index])

    def spread(self, legs: Sequence[T]) -> tuple[T, ...]:
        """Of something for each leg of the distinct runs that of each leg of the whole program."""
        parts: list[tuple[T, ...]] = []
        passed = 0
        for run in self.program.runs:
            parts.append(tuple(legs[passed : passed + len(run.demands)]))
            passed += len(run.demands)
        return tuple(leg for index in self.of_run for leg in parts[index])


def merge_alike(program: Program) -> AlikeRuns:
    """Runs with equal demands as one that is made so many times; none where a part of the legs has a time."""
    keys = [run.key() for run in program.runs]
    if program.divided or program.counts or len(set(keys)) == len(keys):
        return AlikeRuns(program, tuple(range(len(keys))))
    distinct = dict(zip(reversed(keys), reversed(program.runs), strict=True))
    order = list(dict.fromkeys(keys))
    runs = tuple(distinct[key] for key in order)
    legs = sum(len(run.demands) for run in runs)
    merged = replace(
        program,
        runs=runs,
        budgets=tuple(Budget(legs, budget.time) for budget in program.budgets),
        counts=tuple(keys.count(key) for key in order),
    )
    return AlikeRuns(merged, tuple(order.index(key) for key in keys))
