"""The geometry of a set of orientations: who is near whom, and what lies on one great circle."""
