"""Functions on [0, 1] whatever their form: what proofs and pictures ask of them."""

from collections import defaultdict
from collections.abc import Sequence
from typing import Protocol, Self

from timelaw.numerics.array import Array
from timelaw.numerics.extrema import Peak


class Function(Protocol):
    """A function of a form that knows how to be evaluated and enclosed."""

    @property
    def degree(self) -> int:
        """How much it can bend: a picture takes a few points for each degree."""
        ...

    def __call__(self, u: Array) -> Array:
        """Values at u (m,)."""
        ...

    @classmethod
    def enclose_all(cls, functions: Sequence[Self]) -> list[Peak]:
        """Max |f| of each, with its own rounding in the upper bound."""
        ...


def enclose_peaks(functions: Sequence[Function]) -> list[Peak]:
    """Enclose max |f| of each function, those of one form together; in the given order."""
    by_form: dict[type[Function], list[int]] = defaultdict(list)
    for index, function in enumerate(functions):
        by_form[type(function)].append(index)
    found: dict[int, Peak] = {}
    for form, indices in by_form.items():
        found.update(zip(indices, form.enclose_all([functions[i] for i in indices]), strict=True))
    return [found[i] for i in range(len(functions))]
