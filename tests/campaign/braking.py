"""What changing speed takes, by the time of ramps; without acceleration at the ends where jerk is limited."""

from math import inf, sqrt

import numpy as np

from tests.campaign.least import ramp

SPEEDS = 2001


def least_change(fast: float, slow: float, a: float, j: float) -> float:
    """Angle from one speed to another without turning back: down to some speed first, and up again."""

    def angle(turn: float) -> float:
        return sum((v + turn) / 2 * ramp(v - turn, a, j) for v in (fast, slow) if v > turn)

    return min(angle(turn) for turn in np.linspace(0, slow, SPEEDS).tolist())


def least_stop(speed: float, a: float, j: float) -> float:
    """Angle to rest, by constant deceleration, or by constant jerk that goes on to where the body stands."""
    time = sqrt(2 * speed / j) if j < inf else 0.0
    by_jerk = speed * time - j * time**3 / 6 if j < inf else 0.0
    return max(speed**2 / (2 * a) if a < inf else 0.0, by_jerk)
