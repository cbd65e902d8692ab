"""The registry of objectives, by the key they have in problem files.

An effort is an integral over the motion, ∫ g(φ', φ'', …) dt leg by leg; with n the leg's fixed
axis, |α| = |φ''| and |jerk| = |φ'''|. For given time the least ∫|jerk|² is the quintic's,
720 θ²/T⁵; the least ∫|α|² with ω continuous is 12 θ²/T³, of 3τ² - 2τ³; the least ∫|snap|² is the
septic's, 100800 θ²/T⁷.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from timelaw.limits import Demand


@dataclass(frozen=True)
class Effort:
    """∫ g dt: `integrand(demand, rates)` is g on a leg, `rates[k]` the k-th rate in whatever form."""

    unit: str
    orders: tuple[int, ...]
    integrand: Callable[[Demand, Mapping[int, Any]], Any]


def _torque(demand: Demand, rates: Mapping[int, Any]) -> Any:
    if demand.torque is None:
        raise ValueError("the torque of a leg needs the inertia")
    return demand.torque.value(rates)


EFFORTS: dict[str, Effort] = {
    "energy": Effort("rad²/s³", (2,), lambda _, rates: rates[2] * rates[2]),
    "jerk": Effort("rad²/s⁵", (3,), lambda _, rates: rates[3] * rates[3]),
    "snap": Effort("rad²/s⁷", (4,), lambda _, rates: rates[4] * rates[4]),
    "torque": Effort("N²·m²·s", (1, 2), _torque),
}
