"""What objectives are made of, as expressions of a program's symbols."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca

from timelaw.interrupts import check_interrupted
from timelaw.nlp.leg_symbols import LegSymbols, rates_at
from timelaw.nlp.program import Program
from timelaw.objectives import EFFORTS


@dataclass(frozen=True)
class Terms:
    """What objectives are made of, as expressions; see `timelaw.objectives.objective.Terms`."""

    program: Program
    symbols: Sequence[LegSymbols]
    unit: float
    scale: float
    used_part: Any

    @property
    def legs(self) -> int:
        """How many."""
        return sum(self.program.leg_counts)

    @property
    def weight(self) -> float | None:
        """Of an effort against time."""
        return self.program.weight

    @property
    def elastic(self) -> bool:
        """Whether time may be stretched afterwards."""
        return self.program.elastic

    @property
    def time(self) -> Any:
        """Total time in mean durations of the start."""
        return (
            ca.dot(self.program.leg_counts, ca.vertcat(*(leg.duration for leg in self.symbols))) / self.unit
        )

    def effort(self, name: str) -> Any:
        """∫ g dt over all legs over that of the start, by Gauss-Legendre, exact for polynomials."""
        effort = EFFORTS[name]
        terms = []
        for demand, leg, basis in zip(self.program.demands, self.symbols, self.program.bases, strict=True):
            check_interrupted()
            tau, weights = basis.quadrature()
            rates = rates_at(demand.angle, leg, basis, tau, effort.orders)
            terms.append(leg.duration * ca.dot(ca.DM(weights), effort.integrand(demand, rates)))
        return ca.dot(ca.DM(self.program.leg_counts), ca.vertcat(*terms)) / (self.scale or 1.0)
