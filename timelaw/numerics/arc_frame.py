"""The frame of a great-circle arc on S³: its ends, the tangents there, and what is at right angles to it."""

from dataclasses import dataclass

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import UNIT_ROUNDOFF
from timelaw.numerics.quaternion import normalise

FRAME_ROUNDING = 32 * UNIT_ROUNDOFF  # of each component, over the angle between the ends


@dataclass(frozen=True)
class ArcFrame:
    """Unit vectors (4,): along the arc at its start and at its end, and two across (2, 4).

    x is before the arc where `first` · x < 0, beyond it where `last` · x > 0; of a unit x the sine of the
    angle to the circle is |across x|. Each component is within `error` of what the ends define.
    """

    first: Array
    last: Array
    across: Array
    error: float


def frame_arc(start: Array, end: Array) -> ArcFrame:
    """The frame of the shorter arc from one unit quaternion (4,) to another."""
    start, end = normalise(start), normalise(end)
    cosine = float(start @ end)
    first = end - cosine * start
    size = float(np.linalg.norm(first))
    plane = np.stack([start, normalise(first)], axis=1)
    basis, _ = np.linalg.qr(plane, mode="complete")
    return ArcFrame(
        normalise(first),
        normalise(cosine * end - start),
        basis[:, 2:].T,
        FRAME_ROUNDING / max(size, UNIT_ROUNDOFF),
    )
