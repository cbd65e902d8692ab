"""Easings: functions f(τ) on [0, 1] from 0 to 1 that say how a leg is run through in its time."""

from timelaw.easing.easing import Easing, Timing
from timelaw.easing.family import Basis, DoubleSFamily, Family, PolynomialFamily, SplineFamily
from timelaw.easing.polynomial import PolynomialBasis
from timelaw.easing.spline import SplineBasis
from timelaw.easing.stretch import fit_to_limits, fraction, utilisation
from timelaw.limits.polynomials import row_polynomials

__all__ = [
    "Basis",
    "DoubleSFamily",
    "Easing",
    "Family",
    "PolynomialBasis",
    "PolynomialFamily",
    "SplineBasis",
    "SplineFamily",
    "Timing",
    "fit_to_limits",
    "fraction",
    "row_polynomials",
    "utilisation",
]
