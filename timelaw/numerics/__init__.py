"""Quaternion algebra and polynomials in Bernstein form: the ground everything stands on."""
