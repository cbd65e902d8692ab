"""Easings: functions f(τ) on [0, 1] from 0 to 1 that say how a leg is run through in its time."""

from timelaw.easing.easing import Easing, Timing
from timelaw.easing.polynomial import PolynomialBasis
from timelaw.easing.stretch import fit_to_limits, fraction, row_polynomials, utilisation

BASES = {"polynomial": PolynomialBasis}

__all__ = [
    "BASES",
    "Easing",
    "PolynomialBasis",
    "Timing",
    "fit_to_limits",
    "fraction",
    "row_polynomials",
    "utilisation",
]
