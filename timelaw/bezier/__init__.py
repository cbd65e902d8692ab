"""Bézier motions: curves of quaternions and points as they are given, and easings that run through them."""
