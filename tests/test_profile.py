"""Profiles in state form: exact fractions, SciPy's B-splines, and pieces far shorter than a double tells apart."""

from fractions import Fraction
from itertools import pairwise
from math import comb, inf

import numpy as np
import pytest
from numpy.polynomial import polynomial as power
from scipy.interpolate import BSpline

from tests.cases import demands
from timelaw.easing import Profile
from timelaw.easing.double_s_easing import cut_double_s, fit_double_s
from timelaw.easing.joining import join_pieces
from timelaw.easing.piece_stack import sample_profiles
from timelaw.easing.polynomial_basis import PolynomialBasis
from timelaw.easing.profile import Piece
from timelaw.easing.spline_basis import SplineBasis
from timelaw.easing.spline_rates import expand_spline
from timelaw.least_time.double_s import double_s_time

DEG = np.pi / 180


def join(durations, controls, start, end, smooth):
    """One profile."""
    states, controls = join_pieces(durations, controls[None], start, end, smooth=smooth)
    return Profile(tuple(map(Piece, durations.tolist(), states[0], controls[0])))


def exact(piece: Piece, order: int) -> list[Fraction]:
    """Control points of the k-th derivative over the piece, exactly: by powers of u, and back."""
    n, h = len(piece.control) - 1, Fraction(piece.duration)
    control = [Fraction(c) for c in piece.control]
    top = [
        comb(n, k) * sum((-1) ** (k - i) * comb(k, i) * control[i] for i in range(k + 1))
        for k in range(n + 1)
    ]
    for value in map(Fraction, piece.state[::-1]):
        top = [value, *(c * h / k for k, c in enumerate(top, 1))]
    for _ in range(order):
        top = [c * k / h for k, c in enumerate(top)][1:] or [Fraction(0)]
    m = len(top) - 1
    return [sum(Fraction(comb(j, k), comb(m, k)) * top[k] for k in range(j + 1)) for j in range(m + 1)]


@pytest.mark.parametrize("seed", range(40))
def test_every_order_is_within_its_rounding_of_the_exact_one(seed):
    rng = np.random.default_rng(seed)
    size, width = rng.integers(1, 6), rng.integers(1, 9)
    state = rng.normal(size=size) * 10.0 ** rng.integers(-6, 6, size)
    control = rng.normal(size=width) * 10.0 ** rng.integers(-6, 12)
    piece = Piece(float(10 ** rng.uniform(-9, 6)), state, control)
    for order in range(size + 3):
        (found,) = Profile((piece,)).derivative(order)
        wanted = exact(piece, order)
        assert len(found.control) == len(wanted)
        off = max(abs(Fraction(c) - w) for c, w in zip(found.control.tolist(), wanted, strict=True))
        assert off <= Fraction(found.error)
        assert found.error <= 1e-11 * found.size or order > size


def test_a_piece_keeps_its_jerk_however_short_it_is():
    """1e-25 of a second beside one second: no difference of times could tell its length."""
    brief = Piece(1e-25, np.zeros(3), np.array([3e24]))
    profile = Profile((brief, Piece(1.0, np.array([0.0, 1.5e-26, 0.3]), np.zeros(1))))
    assert profile(profile.breaks[1], 3, "left") == 3e24
    assert (
        profile(profile.breaks[1], 2, "left") == profile(profile.breaks[1], 2, "right") == pytest.approx(0.3)
    )
    assert profile(1.0) == pytest.approx(0.15)


@pytest.mark.parametrize(("degree", "continuity"), [(4, 2), (5, 3), (6, 2), (7, 4), (3, 1)])
def test_the_highest_derivative_of_a_spline_is_scipys(degree, continuity):
    rng = np.random.default_rng(degree)
    breaks = np.concatenate([[0.0], np.sort(rng.uniform(0.1, 0.9, 9)), [1.0]])
    knots = np.concatenate([[0.0] * degree, breaks, [1.0] * degree])
    spline = BSpline(knots, rng.normal(size=len(knots) - degree - 1), degree)
    r = continuity + 1
    left, right = ([float(spline(end, nu=k)) for k in range(r)] for end in (0.0, 1.0))
    states, controls = expand_spline(breaks, degree, np.array(left), spline.c[r:-r], np.array(right))
    for k in range(r):
        wanted = spline(breaks[:-1], nu=k)
        np.testing.assert_allclose(states[:, k], wanted, rtol=1e-8, atol=1e-8 * np.max(np.abs(wanted)))
    assert states[0].tolist() == left
    ends = np.nextafter(breaks, [*[2.0] * 10, 0.0])
    wanted = spline.derivative(r)
    np.testing.assert_allclose(
        controls[:, 0], wanted(breaks[:-1]), rtol=1e-7, atol=1e-8 * np.max(np.abs(controls))
    )
    before = np.nextafter(ends[1:], 0)
    np.testing.assert_allclose(
        controls[:, -1], wanted(before), rtol=1e-7, atol=1e-8 * np.max(np.abs(controls))
    )


def test_splines_of_continuity_4_keep_their_digits_through_a_cruise():
    """A ramp of 1e-6 of the leg has a fourth derivative of 1e18: 1e-16 of that would be all of the slope."""
    r = 1e-6
    breaks = (0.0, *(r * k / 8 for k in range(1, 9)), *(1 - r * k / 8 for k in range(8, 0, -1)), 1.0)
    basis = SplineBasis(7, breaks, 4, (1.0, 1 / r, 1 / r**2))
    even = Profile.single([0.0, 1.0], 0)
    rest = np.eye(5)[0]
    easing = basis.easing(0 * rest, basis.free_of(even), rest)
    for order in range(5):
        rates = easing.derivative(order)
        largest = max(rate.size for rate in rates)
        for a, b in pairwise(rates):
            assert a.control[-1] == pytest.approx(b.control[0], abs=1e-12 * largest)
        assert easing.end(order) == pytest.approx(rest[order], abs=1e-12 * largest)


@pytest.mark.parametrize("seed", range(20))
def test_joined_pieces_share_their_states_and_end_where_they_should(seed):
    rng = np.random.default_rng(seed)
    count, size, width = rng.integers(1, 30), rng.integers(2, 6), rng.integers(2, 6)
    durations = 10 ** rng.uniform(-4, 0, count)
    durations /= durations.sum()
    controls = rng.normal(size=(count, width))
    start, end = rng.normal(size=(2, size))
    smooth = bool(seed % 2) and count > 1
    profile = join(durations, controls, start, end, smooth)
    scale = max(1.0, *(np.max(np.abs(p.control)) for p in profile.pieces))
    for order in range(size + smooth):
        rates = profile.derivative(order)
        for left, right in pairwise(rates):
            assert left.control[-1] == pytest.approx(right.control[0], abs=1e-13 * scale)
        if order < size:
            assert rates[0].control[0] == start[order]
            assert rates[-1].control[-1] == pytest.approx(end[order], abs=1e-12 * scale)


def test_what_is_joined_is_changed_by_no_more_than_was_missing():
    """A polynomial that already ends where it should keeps its control points."""
    coefficients = np.array([0, 0, 0, 10, -15, 6])
    control = np.array([60.0, -120.0, 60.0])
    profile = join(np.ones(1), control[None], np.zeros(3), np.array([1.0, 0, 0]), smooth=False)
    np.testing.assert_allclose(profile.pieces[0].control, control, rtol=1e-13)
    tau = np.linspace(0, 1, 50)
    np.testing.assert_allclose(profile(tau), power.polyval(tau, coefficients), atol=1e-14)


@pytest.mark.parametrize("continuity", [2, 3, 4])
@pytest.mark.parametrize("degree", [9, 19, 31])
def test_easings_of_high_degree_end_exactly_and_join(degree, continuity):
    if degree < 2 * continuity + 1:
        pytest.skip("no such basis")
    rng = np.random.default_rng(degree)
    basis = PolynomialBasis(degree, continuity)
    right = np.eye(continuity + 1)[0]
    easing = basis.easing(0 * right, 10 * rng.normal(size=basis.free), right)
    for order in range(continuity + 1):
        size = np.max(np.abs(easing(np.linspace(0, 1, 201), order)))
        assert easing.end(order) == pytest.approx(right[order], abs=1e-10 * size)
        for a, b in pairwise(easing.derivative(order)):
            assert a.control[-1] == pytest.approx(b.control[0], abs=1e-10 * size)


def test_spline_easings_of_short_intervals_have_no_drift():
    """With four derivatives to be integrated, what one short interval is off by would spread over the leg."""
    breaks = (0.0, 1e-5, 3e-5, 1e-3, 0.2, 0.5, 0.8, 0.999, 1 - 3e-5, 1 - 1e-5, 1.0)
    basis = SplineBasis(5, breaks, 3, (1.1, 50.0, 1e6))
    smooth = Profile.single([0.0] * 4 + [1.0] * 4, 3)
    rest = np.eye(4)[0]
    easing = basis.easing(0 * rest, basis.free_of(smooth), rest)
    control = basis.from_free @ basis.free_of(smooth) + basis.from_right @ rest
    tau = np.linspace(0, 1, 300)
    for order in (0, 1):
        np.testing.assert_allclose(easing(tau, order), basis.values(tau, order) @ control, atol=1e-9)


# A node anywhere on the double-S: before, on and after a phase boundary, by any rounding

LIMITS = (60 * DEG, 120 * DEG, 600 * DEG)


@pytest.mark.parametrize("limits", [LIMITS, (inf, *LIMITS[1:]), (inf, inf, LIMITS[2]), (1.0, 1e-3, 1e6)])
@pytest.mark.parametrize("off", [0.0, 1e-16, -1e-16, 1e-15, 1e-12, -1e-12, 1e-10, 1e-8, -1e-8, 1e-5])
def test_steps_that_are_equal_but_for_rounding(limits, off):
    for angles in (
        (0.1, 0.1 + off),
        (0.1 + off, 0.1),
        (0.1, 0.1 + off, 0.1),
        (0.3 + off, 0.1, 0.1, 0.1 - off),
    ):
        timings = cut_double_s(angles, *limits)
        check_run(angles, timings, double_s_time(sum(angles), *limits))


@pytest.mark.parametrize("seed", range(60))
def test_a_node_at_a_phase_boundary(seed):
    """Where a phase ends, and a few roundings to either side."""
    rng = np.random.default_rng(seed)
    bounds = [float(10 ** rng.uniform(-4, 4)) if rng.random() > 0.25 else inf for _ in range(3)]
    if bounds[1:] == [inf, inf]:
        bounds[1] = 1.0
    total = float(10 ** rng.uniform(-2, 1))
    (whole,) = cut_double_s([total], *bounds)
    ends = [total * p.control[-1] for p in whole.easing.derivative(0)[:-1]]
    for end in ends:
        for off in (0.0, *(rng.uniform(-1, 1, 3) * 10.0 ** rng.integers(-17, -3, 3) * total)):
            if 1e-12 * total < end + off < total * (1 - 1e-12):
                angles = (end + off, total - (end + off))
                check_run(angles, cut_double_s(angles, *bounds), double_s_time(total, *bounds))


def check_run(angles, timings, time):
    """The closed form's time, every leg's angle, and rates that join at the nodes to 1e-12 of the largest."""
    assert sum(t.duration for t in timings) == pytest.approx(time, rel=1e-12)
    profiles = [t.profile(angle) for t, angle in zip(timings, angles, strict=True)]
    for profile, angle in zip(profiles, angles, strict=True):
        assert profile.end(0) == pytest.approx(angle, abs=1e-14 * sum(angles))
    for order in range(len(profiles[0].pieces[0].state)):
        rates = [rate.control for profile in profiles for rate in profile.derivative(order)]
        largest = max(np.max(np.abs(rate)) for rate in rates)
        starts = np.cumsum([0, *(len(profile.pieces) for profile in profiles)])
        for k in range(1, len(rates)):
            if order or k not in starts:
                assert rates[k - 1][-1] == pytest.approx(rates[k][0], abs=1e-12 * largest)


def test_the_profile_is_within_its_limits_and_no_slower_than_rounding():
    legs = demands(
        (0.0872664625997, 0.0872664626007),
        dict(zip(("velocity", "acceleration", "jerk"), LIMITS, strict=True)),
    )
    timings = fit_double_s(legs)
    assert sum(t.duration for t in timings) == pytest.approx(0.8110100926, rel=1e-9)


def test_many_profiles_are_sampled_as_each_alone():
    rng = np.random.default_rng(8)
    profiles = []
    for count in (1, 2, 5, 3):
        shapes = [(1 + (count + k) % 3, 1 + (2 * count + k) % 4) for k in range(count)]
        pieces = [Piece(rng.uniform(0.1, 2), rng.normal(size=c), rng.normal(size=m)) for c, m in shapes]
        profiles.append(Profile(tuple(pieces)))
    tau = np.unique(np.concatenate([np.linspace(0, 1, 101), *(profile.breaks for profile in profiles)]))
    for order in range(4):
        found = sample_profiles(profiles, tau, order)
        for profile, values in zip(profiles, found, strict=True):
            np.testing.assert_array_equal(values, profile(tau, order))
