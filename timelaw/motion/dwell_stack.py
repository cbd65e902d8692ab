"""Many dwells as one stack, for values at many instants."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from timelaw.motion.dwell import Dwell
from timelaw.numerics.array import Array
from timelaw.numerics.chebyshev import Points, Rows
from timelaw.numerics.quaternion import normalise


@dataclass(frozen=True)
class DwellStack:
    """Where the body rests: unit quaternions (N, 4); how long (N,) [s]."""

    orientations: Array
    durations: Array

    @classmethod
    def stack(cls, dwells: Sequence[Dwell]) -> "DwellStack":
        """All of them; each is one piece."""
        durations = np.array([dwell.duration for dwell in dwells])
        return cls(normalise([dwell.orientation for dwell in dwells]), durations)

    def fill(self, rows: Rows, points: Points, values: Mapping[int, Array]) -> None:  # noqa: ARG002
        """Write q (m, 4) and rates (m, 3) of zero, by order."""
        for order, value in values.items():
            value[:] = 0.0 if order else self.orientations[rows]
