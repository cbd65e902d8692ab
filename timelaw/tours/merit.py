"""What a tour is judged by: a value, the best that any tour can reach, and how that is known."""

from dataclasses import dataclass

LENGTH = "length"
EQUAL = 1e-9  # relative; a value this near to its bound has reached it


@dataclass(frozen=True)
class Merit:
    """`value` of a tour and a proved `bound` on it: no tour has less, or with `most`, none has more.

    Lengths and turning in rad, times in s. `proof` says how the bound is known; `asked`, whether the
    tour was searched for that.
    """

    name: str
    value: float
    bound: float
    proof: str
    most: bool = False
    asked: bool = True

    @property
    def is_best(self) -> bool:
        """Whether the bound is reached, which proves the tour best in this."""
        short = self.bound - self.value if self.most else self.value - self.bound
        return short <= EQUAL * abs(self.bound)

    @property
    def gap(self) -> float:
        """How far from the bound, as a part of it; the true gap to the best tour is not larger.

        Infinite where the bound says nothing.
        """
        if self.is_best:
            return 0.0
        return abs(self.value - self.bound) / self.bound if self.bound > 0 else float("inf")


@dataclass(frozen=True)
class Searched:
    """An order of visits that a search has found, and the merits the search can vouch for."""

    order: tuple[int, ...]
    merits: tuple[Merit, ...] = ()
