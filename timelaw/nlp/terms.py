"""What objectives are made of: the weights that time, efforts and the used part of the limits have in one."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

import numpy as np

from timelaw.nlp.monomials import expand_monomials
from timelaw.nlp.point_rows import Form, PointRows
from timelaw.nlp.program import Program
from timelaw.nlp.variables import LegVariables
from timelaw.objectives import EFFORTS


@dataclass
class Terms:
    """What objectives are made of; see `timelaw.objectives.objective.Terms`."""

    program: Program
    scale: float
    time: float = 0.0
    used_part: float = 0.0
    efforts: dict[str, float] = field(default_factory=dict)

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

    def effort(self, name: str) -> float:
        """Its value; noted if it is asked for."""
        return self.efforts.setdefault(name, 0.0)


class Weights(NamedTuple):
    """What each term counts: time in mean durations of the start, the used part, efforts by name."""

    time: float
    used_part: float
    efforts: Mapping[str, float]


def weigh_terms(program: Program, scale: float) -> Weights:
    """The weights of an objective's terms, which it is linear in."""
    express, blank = program.objective.expression, Terms(program, scale)
    none = express(blank)
    return Weights(
        express(Terms(program, scale, time=1.0)) - none,
        express(Terms(program, scale, used_part=1.0)) - none,
        {name: express(Terms(program, scale, efforts={name: 1.0})) - none for name in blank.efforts},
    )


def list_effort_rows(
    program: Program, legs: Sequence[LegVariables], weights: Mapping[str, float], scale: float
) -> list[PointRows]:
    """∫ g dt of each leg as often as it is made, by Gauss-Legendre, exact for polynomials."""
    found = []
    for name, weight in weights.items():
        effort = EFFORTS[name]
        for leg, count in zip(legs, program.leg_counts, strict=True):
            tau, parts = leg.basis.quadrature()
            exponents, coefficients = expand_monomials(partial(effort.integrand, leg.demand), effort.orders)
            each = weight * count * leg.unit / (scale or 1.0) * parts
            free = np.full(len(tau), np.inf)
            form = Form(effort.orders, exponents, lasting=1)
            found.append(PointRows(leg, form, tau, np.outer(each, coefficients), -free, free))
    return found
