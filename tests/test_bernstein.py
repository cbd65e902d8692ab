"""Bernstein polynomials against NumPy's power and Chebyshev series and exact fractions."""

from fractions import Fraction
from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.oracles import extremum
from timelaw.numerics import bernstein as bern
from timelaw.numerics.extrema import enclose_polynomials

control_points = st.lists(st.floats(-10, 10), min_size=1, max_size=12).map(np.array)


def to_power(control):
    """Exact conversion to powers in fractions: Σ c_i C(n,i) u^i (1-u)^(n-i)."""
    n = len(control) - 1
    result = [Fraction(0)] * (n + 1)
    for i, c in enumerate(control):
        for j in range(n - i + 1):
            result[i + j] += Fraction(float(c)) * comb(n, i) * comb(n - i, j) * (-1) ** j
    return result


def exact(control, u, order=0):
    coefficients = to_power(control)
    for _ in range(order):
        coefficients = [k * c for k, c in enumerate(coefficients)][1:] or [Fraction(0)]
    return float(sum(c * Fraction(u) ** k for k, c in enumerate(coefficients)))


@given(control_points, st.floats(0, 1), st.integers(0, 4))
def test_values_and_derivatives(control, u, order):
    value = bern.evaluate(bern.differentiate(control, order), u)
    n = len(control)
    assert value == pytest.approx(exact(control, u, order), abs=1e-12 * 10 * max(n, 2) ** order)


@given(control_points, st.floats(0, 1))
def test_elevation_and_splitting_leave_the_polynomial_alone(control, u):
    elevated = bern.elevate(control, len(control) + 3)
    assert bern.evaluate(elevated, u) == pytest.approx(exact(control, u), abs=1e-12)
    left, right = bern.split(control, 0.3)
    assert bern.evaluate(left, u) == pytest.approx(exact(control, 0.3 * u), abs=1e-12)
    assert bern.evaluate(right, u) == pytest.approx(exact(control, 0.3 + 0.7 * u), abs=1e-12)


@pytest.mark.parametrize("degree", [5, 9, 31])
def test_basis_and_hermite_matrices(degree):
    rng = np.random.default_rng(degree)
    control, tau = rng.normal(size=degree + 1), np.array([0.0, 0.1, 0.5, 1.0])
    for order in range(4):
        expected = [exact(control, t, order) for t in tau]
        np.testing.assert_allclose(
            bern.basis_matrix(degree, tau, order) @ control, expected, rtol=1e-10, atol=1e-7
        )
    derivatives = [exact(control, 0, i) for i in range(3)]
    np.testing.assert_allclose(bern.hermite_matrix(degree, 3) @ derivatives, control[:3], rtol=1e-10)


@given(control_points)
def test_the_integral_of_the_square_is_exact(control):
    terms = list(enumerate(to_power(control)))
    integral = float(sum(a * b / (i + j + 1) for i, a in terms for j, b in terms))
    assert bern.integrate_square(control) == pytest.approx(integral, rel=1e-12, abs=1e-300)


@given(st.lists(st.floats(-10, 10).map(lambda x: round(x, 3)), min_size=1, max_size=10).map(np.array))
def test_peaks_enclose_the_extremum_that_the_roots_give(control):
    peak = enclose_polynomials([control])[0]
    expected = extremum(np.array([float(c) for c in to_power(control)]))
    assert peak.lower <= peak.upper <= peak.lower * (1 + 1e-12) + 1e-300
    assert peak.lower == pytest.approx(expected, rel=1e-9, abs=1e-12)
    assert abs(exact(control, peak.at)) == pytest.approx(peak.lower, rel=1e-12, abs=1e-12)


def test_peaks_of_high_degree_ripples_and_of_many_at_once():
    rng = np.random.default_rng(1)
    stack = [rng.normal(size=n) for n in (1, 2, 4, 32, 32, 4, 1)]
    for control, peak in zip(stack, enclose_polynomials(stack), strict=True):
        u = np.linspace(0, 1, 20001)
        sampled = np.max(np.abs(bern.evaluate(control, u)))
        assert sampled <= peak.upper
        assert peak.lower == pytest.approx(sampled, rel=1e-5)


def test_the_peak_of_a_basis_polynomial_is_where_calculus_puts_it():
    control = np.zeros(32)
    control[17] = 1.0  # b_17 of degree 31 peaks at 17/31
    peak = enclose_polynomials([control])[0]
    assert peak.at == pytest.approx(17 / 31, abs=1e-6)
    assert peak.lower == pytest.approx(comb(31, 17) * (17 / 31) ** 17 * (14 / 31) ** 14, rel=1e-12)


def chebyshev_control(degree):
    """Control points of T_n on [0, 1], exact as fractions: wild, while |T_n| ≤ 1."""
    previous, current = [Fraction(1)], [Fraction(-1), Fraction(2)]  # powers of u, of T_0 and T_1 at 2u - 1
    for _ in range(degree - 1):
        doubled = [Fraction(0)] * (len(current) + 1)
        for i, c in enumerate(current):
            doubled[i] -= 2 * c
            doubled[i + 1] += 4 * c
        for i, c in enumerate(previous):
            doubled[i] -= c
        previous, current = current, doubled
    n = degree
    return [sum(current[j] * Fraction(comb(i, j), comb(n, j)) for j in range(i + 1)) for i in range(n + 1)]


@pytest.mark.parametrize("degree", [10, 20, 30, 40])
def test_bounds_are_proved_also_where_control_points_are_wild(degree):
    """T_n has control points of up to 1e10 and more, whose rounding moves the extremum off 1."""
    control = np.array([float(c) for c in chebyshev_control(degree)])
    peak = enclose_polynomials([control])[0]
    tops = [Fraction(i, 4096) for i in range(4097)]
    basis = [
        [comb(degree, i) * t**i * (1 - t) ** (degree - i) for i in range(degree + 1)] for t in tops[::64]
    ]
    exact_control = [Fraction(c) for c in control]
    values = [abs(sum(b * c for b, c in zip(row, exact_control, strict=True))) for row in basis]
    assert Fraction(peak.upper) >= max(values)
    assert Fraction(peak.lower) <= Fraction(peak.upper)


def test_nothing_that_is_not_finite_has_a_finite_peak():
    for wrong in (np.nan, np.inf, -np.inf):
        for place in range(4):
            control = np.array([0.5, 0.1, 0.2, 0.3])
            control[place] = wrong
            assert enclose_polynomials([control])[0].upper == np.inf


def test_subnormal_and_constant_polynomials_end():
    rng = np.random.default_rng(3)
    stack = [rng.uniform(0.9, 1.2, 7) * 1e-321 for _ in range(50)] + [
        np.full(32, 0.1) + rng.normal(size=32) * 1e-16
    ]
    found = enclose_polynomials(stack)
    assert all(peak.upper >= np.max(np.abs(c[[0, -1]])) for peak, c in zip(found, stack, strict=True))
