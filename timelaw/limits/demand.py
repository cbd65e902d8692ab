"""What must hold on one leg."""

from dataclasses import dataclass

from timelaw.limits.coupled_row import TorqueNormRow
from timelaw.limits.row import Row


@dataclass(frozen=True)
class Demand:
    """The angle to travel [rad], the rows of all limits there, and the duration [s] if it is fixed.

    `torque` is the norm of the torque on the leg, where the inertia is known: what an objective
    may make least, whether or not it is limited.
    """

    angle: float
    rows: tuple[Row, ...]
    duration: float | None = None
    torque: TorqueNormRow | None = None

    def key(self) -> tuple[object, ...]:
        """Equal for demands that have equal solutions: numbers agree to 13 digits, as lattices' do."""
        torque = tuple(_digits(c) for c in self.torque.coefficients()) if self.torque else ()
        return (_digits(self.angle), self.rows_key(), self.duration, torque)

    def rows_key(self) -> tuple[object, ...]:
        """Equal for demands whose rows are the same."""
        return tuple((row.label, *(_digits(c) for c in row.coefficients())) for row in self.rows)


def _digits(value: float) -> str:
    """A number to 13 digits, rounding noise around zero gone."""
    return f"{value if abs(value) > 1e-13 else 0.0:.12e}"
