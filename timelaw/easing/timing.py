"""How one leg is run through: in what time, by which easing."""

from dataclasses import dataclass

from timelaw.easing.easing import Easing
from timelaw.numerics.polynomial import Polynomial


@dataclass(frozen=True)
class Timing:
    """How one leg is run through: in `duration` [s], by `easing`."""

    duration: float
    easing: Easing

    def rates(self, angle: float, order: int) -> list[Polynomial]:
        """The polynomials d^k φ/dt^k = θ f^(k)/T^k on the intervals."""
        return [piece * (angle / self.duration**order) for piece in self.easing.derivative(order)]

    def stretched(self, factor: float) -> "Timing":
        """The same easing in `factor` times the time."""
        return Timing(self.duration * factor, self.easing)
