"""Orientation sets: labelled unit quaternions, from a lattice, a table or the problem file itself."""

from timelaw.orientations.orientation_set import OrientationSet, read_orientations

__all__ = ["OrientationSet", "read_orientations"]
