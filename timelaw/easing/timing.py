"""How one leg is run through: in what time, by which easing."""

from dataclasses import dataclass

from timelaw.easing.profile import Profile
from timelaw.numerics.polynomial import Polynomial


@dataclass(frozen=True)
class Timing:
    """How one leg is run through: in `duration` [s], by `easing`, a profile from 0 to 1 in the time 1."""

    duration: float
    easing: Profile

    def profile(self, angle: float) -> Profile:
        """The angle travelled as a function of time."""
        return self.easing.scaled(angle, self.duration)

    def rates(self, angle: float, order: int) -> list[Polynomial]:
        """The polynomials d^k φ/dt^k = θ f^(k)/T^k on the intervals."""
        return [piece * (angle / self.duration**order) for piece in self.easing.derivative(order)]

    def stretched(self, factor: float) -> "Timing":
        """The same easing in `factor` times the time."""
        return Timing(self.duration * factor, self.easing)
