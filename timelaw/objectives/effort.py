"""Efforts: objectives that are integrals over the motion, ∫ g(φ', φ'', …) dt leg by leg.

With n the leg's fixed axis, |α| = |φ''| and |jerk| is the third rate's size. For given time the least
∫|jerk|² is the quintic's, 720 θ²/T⁵; the least ∫|α|² with ω continuous is 12 θ²/T³, of 3τ² - 2τ³; the
least ∫|snap|² is the septic's, 100800 θ²/T⁷.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from timelaw.easing import Timing
from timelaw.limits import Demand
from timelaw.objectives.objective import Terms

NODES = 64  # Gauss-Legendre is exact up to degree 127, the fourth power of a slope of degree 31 is of 120


@dataclass(frozen=True)
class Effort:
    """∫ g dt: `integrand(demand, rates)` is g on a leg, `rates[k]` the k-th rate in whatever form.

    The highest of the `orders` that enter is finite only where the rate below it does not jump.
    """

    name: str
    symbol: str
    unit: str
    orders: tuple[int, ...]
    integrand: Callable[[Demand, Mapping[int, Any]], Any]
    needs_inertia: bool = False
    takes: ClassVar[tuple[str, ...]] = ("total_time", "weight")
    separable: ClassVar[bool] = False
    scales_limits: ClassVar[bool] = False

    @property
    def words(self) -> str:
        """Its name."""
        return self.name

    @property
    def continuity(self) -> int:
        """The rate below the highest one must not jump, and ω never."""
        return max(max(self.orders) - 1, 1)

    def measure(self, demands: Sequence[Demand], timings: Sequence[Timing]) -> float:
        """∫ g dt over legs run through as given, exact up to rounding."""
        result = 0.0
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        for demand, timing in zip(demands, timings, strict=True):
            for left, right in pairwise(timing.easing.breaks.tolist()):
                tau = left + (right - left) * (nodes + 1) / 2
                rates = {k: demand.angle / timing.duration**k * timing.easing(tau, k) for k in self.orders}
                g = self.integrand(demand, rates)
                result += float(np.sum(weights / 2 * g)) * timing.duration * (right - left)
        return result

    scale = measure

    def expression(self, terms: Terms) -> Any:
        """The effort, or with a weight c time + c effort, each relative to the start's."""
        effort = terms.effort(self.name)
        return effort if terms.weight is None else terms.time / terms.legs + terms.weight * effort


def _torque(demand: Demand, rates: Mapping[int, Any]) -> Any:
    if demand.torque is None:
        raise ValueError("the torque of a leg needs the inertia")
    return demand.torque.value(rates)


EFFORTS: dict[str, Effort] = {
    effort.name: effort
    for effort in (
        Effort("jerk", "∫|jerk|² dt", "rad²/s⁵", (3,), lambda _, rates: rates[3] * rates[3]),
        Effort("energy", "∫|α|² dt", "rad²/s³", (2,), lambda _, rates: rates[2] * rates[2]),
        Effort("torque", "∫|τ|² dt", "N²·m²·s", (1, 2), _torque, needs_inertia=True),
        Effort("snap", "∫|snap|² dt", "rad²/s⁷", (4,), lambda _, rates: rates[4] * rates[4]),
    )
}
CALM = EFFORTS["jerk"]
