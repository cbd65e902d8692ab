"""A law as SciPy's objects: rotations at any time, easings as piecewise polynomials."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from timelaw.export.segment_tables import TABLES
from timelaw.motion import QuaternionLaw
from timelaw.numerics.bernstein import elevate

if TYPE_CHECKING:
    from scipy.interpolate import PPoly
    from scipy.spatial.transform import Rotation


@dataclass(frozen=True)
class ScipyMotion:
    """What SciPy knows of a motion; its legs are counted from 0."""

    law: QuaternionLaw

    def rotation(self, t: ArrayLike) -> "Rotation":
        """The orientations at t (m,), body to world: `.apply` turns body vectors into the world.

        Raises:
            ValueError: t outside [0, duration].
        """
        from scipy.spatial.transform import Rotation

        return Rotation.from_quat(self.law(t), scalar_first=True)

    def easing(self, leg: int) -> "PPoly":
        """The easing of a leg as a function of time t [s], from 0 at its start to 1 at its end.

        In powers, as PPoly has it, digits are lost that the law keeps: some 1e-10 at degree 21.

        Raises:
            IndexError: there is no such leg.
            ValueError: the leg is a rational curve, which has no easing.
        """
        from scipy.interpolate import BPoly, PPoly

        legs = self.law.legs
        if not -len(legs) <= leg < len(legs):
            raise IndexError(f"leg {leg}; there are legs 0 to {len(legs) - 1}")
        segment = legs[leg]
        document = segment.document()
        table = TABLES[segment.kind](document)
        if table.curved:
            message = f"leg {segment.name} is a rational curve and has no easing: it turns about no one axis"
            raise ValueError(f"{message}; take rotation(t)")
        angles = [piece.functions[0][:, 0] for piece in table.pieces]
        degree = max(len(angle) for angle in angles) - 1
        control = np.stack([elevate(angle, degree) for angle in angles], axis=1) / document["angle"]
        breaks = segment.start_time + np.array([*table.offsets, segment.duration])
        return PPoly.from_bernstein_basis(BPoly(control, breaks))
