"""Easings against closed forms: smoothsteps, the double-S profile, the solver's basis."""

from itertools import pairwise
from math import inf, isinf

import numpy as np
import pytest
from numpy.polynomial import polynomial as power

from tests.cases import control_points, demand, demands, random_limits
from tests.oracles import QUINTIC, QUINTIC_PEAKS, SEPTIC, SEPTIC_PEAKS, smoothstep_duration
from timelaw.easing import Profile, Timing, smoothstep, time_scaling
from timelaw.easing.double_s_easing import cut_double_s, fit_double_s
from timelaw.easing.polynomial_basis import PolynomialBasis
from timelaw.easing.profile import Piece
from timelaw.easing.time_scaling import fit_to_limits, used_fraction
from timelaw.errors import InfeasibleError
from timelaw.least_time.double_s import double_s_time, list_phases, ramp_times

DEG = np.pi / 180
TAU = np.linspace(0, 1, 101)


@pytest.mark.parametrize(("continuity", "coefficients"), [(2, QUINTIC), (3, SEPTIC)])
@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_smoothsteps_are_the_quintic_and_the_septic(continuity, coefficients, order):
    easing = Profile.single(smoothstep.control_points(continuity), continuity)
    np.testing.assert_allclose(
        easing(TAU, order), power.polyval(TAU, power.polyder(coefficients, order)), atol=1e-11
    )


@pytest.mark.parametrize(("continuity", "peaks"), [(2, QUINTIC_PEAKS), (3, SEPTIC_PEAKS)])
@pytest.mark.parametrize("bounds", [(1, 2, 10), (1, inf, inf), (inf, 2, inf), (inf, inf, 10), (0.01, 3, 5)])
def test_the_smoothsteps_duration_has_its_closed_form(continuity, peaks, bounds):
    given = {n: b for n, b in zip(("velocity", "acceleration", "jerk"), bounds, strict=True) if not isinf(b)}
    timing = smoothstep.time_leg(demand(2.0, given), continuity)
    assert timing.duration == pytest.approx(smoothstep_duration(peaks, 2.0, bounds), rel=1e-10)


def test_a_smoothstep_over_a_run_is_one_polynomial_cut_at_the_nodes():
    limits = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}
    angles = (0.5, 1.5, 1e-3, 0.1)
    timings = smoothstep.time_run(demands(angles, limits), 2)
    whole = smoothstep.time_leg(demand(sum(angles), limits), 2).duration
    assert sum(t.duration for t in timings) == pytest.approx(whole, rel=1e-9)
    for (a, left), (b, right) in pairwise(zip(angles, timings, strict=True)):
        for k in (1, 2, 3):
            end = a * left.easing(1.0, k) / left.duration**k
            assert end == pytest.approx(b * right.easing(0.0, k) / right.duration**k, rel=1e-6)


@pytest.mark.parametrize("continuity", [2, 3, 4])
@pytest.mark.parametrize("seed", range(10))
def test_tiny_legs_of_a_smoothstep_join_to_the_rounding_of_the_run(continuity, seed):
    rng = np.random.default_rng(seed)
    angles = tuple(float(a) for a in 10 ** rng.uniform(-6, 0.4, rng.integers(2, 9)))
    timings = smoothstep.time_run(demands(angles, {"velocity": 1.0, "acceleration": 2.0}), continuity)
    profiles = [timing.profile(angle) for timing, angle in zip(timings, angles, strict=True)]
    for order in range(continuity + 1):
        rates = [profile.derivative(order)[0].control for profile in profiles]
        largest = max(np.max(np.abs(rate)) for rate in rates)
        for profile, angle in zip(profiles, angles, strict=True):
            assert profile.end(0) == pytest.approx(angle, abs=1e-14 * sum(angles))
        for left, right in pairwise(rates if order else ()):
            assert left[-1] == pytest.approx(right[0], abs=1e-12 * largest)
        assert rates[-1][-1] == pytest.approx(0.0 if order else angles[-1], abs=1e-12 * largest)


# θ [deg], limits [deg/s^k], T [s]: jerk alone ∛(32 θ/j), acceleration alone 2√(θ/a), velocity alone θ/w;
# 120° at 60, 120, 600: ramps of 0.2 + 0.5 s, 2 s of cruise less one ramp; and so on.
PROFILES = [
    (120, (inf, inf, 600), (32 * 120 / 600) ** (1 / 3)),
    (120, (inf, 120, inf), 2.0),
    (120, (60, inf, inf), 2.0),
    (120, (60, 120, 600), 2.7),
    (240, (60, 120, 600), 4.7),
    (288, (60, 120, 600), 5.5),
    (120, (60, 120, inf), 2.5),
    (120, (60, inf, 600), 2 + (60 / 600) ** 0.5 * 2),
    (72, (720, 2000, 100000), 0.4),
    (120, (1, 0.05, 0.01), 145.0),
]


@pytest.mark.parametrize(("angle", "bounds", "duration"), PROFILES)
def test_double_s_in_closed_form(angle, bounds, duration):
    assert double_s_time(angle * DEG, *(b * DEG for b in bounds)) == pytest.approx(duration, rel=1e-12)


def integrated(angle, bounds):
    """End of the profile by summing up small steps of its phases' jerk; acceleration may jump between."""
    phases = list_phases(angle, *bounds)
    steps = 2000
    position = velocity = 0.0
    for phase in phases:
        dt = phase.duration / steps
        for i in range(steps):
            a = phase.acceleration + phase.jerk * (i + 0.5) * dt
            position += velocity * dt + a * dt * dt / 2
            velocity += a * dt
    return position, velocity, sum(p.duration for p in phases)


@pytest.mark.parametrize(("angle", "bounds", "duration"), PROFILES)
def test_the_phases_integrate_to_the_angle_and_to_rest(angle, bounds, duration):
    scaled = tuple(b * DEG for b in bounds)
    position, velocity, total = integrated(angle * DEG, scaled)
    assert total == pytest.approx(duration)
    if bounds[1:] == (inf, inf):
        assert position == pytest.approx(0)  # nothing accelerates: the velocity is there from the start
        (only,) = list_phases(angle * DEG, *scaled)
        assert only.at(only.duration)[:2] == pytest.approx((angle * DEG, scaled[0]))
        return
    assert position == pytest.approx(angle * DEG, rel=1e-5)
    assert velocity == pytest.approx(0, abs=1e-5 * max(p.velocity for p in list_phases(angle * DEG, *scaled)))


@pytest.mark.parametrize("seed", range(30))
def test_double_s_scales_with_time_and_is_never_beaten_by_the_quintic(seed):
    rng = np.random.default_rng(seed)
    bounds, angle = tuple(random_limits(rng).values()), 10 ** rng.uniform(-1, 0.5)
    c = 10 ** rng.uniform(-1, 1)
    scaled = (c * bounds[0], c**2 * bounds[1], c**3 * bounds[2])
    assert double_s_time(angle, *scaled) == pytest.approx(double_s_time(angle, *bounds) / c, rel=1e-12)
    assert double_s_time(angle, *bounds) <= smoothstep_duration(QUINTIC_PEAKS, angle, bounds)
    t_j, t_a, t_v = ramp_times(angle, *bounds)
    assert min(t_j, t_a - 2 * t_j * (1 - 1e-12), t_v) >= 0


@pytest.mark.parametrize("seed", range(40))
def test_written_double_s_holds_its_limits_close_to_the_closed_form(seed):
    """Over six decades of limits, cut at nodes, with any of the limits left out."""
    rng = np.random.default_rng(100 + seed)
    given = {n: b for n, b in random_limits(rng).items() if rng.random() > 0.2} or {"jerk": 1.0}
    angles = tuple(float(a) for a in 10 ** rng.uniform(-1, 0.5, rng.integers(1, 5)))
    timings = fit_double_s(demands(angles, given))
    bounds = [given.get(n, inf) for n in ("velocity", "acceleration", "jerk")]
    total = sum(t.duration for t in timings)
    ideal = double_s_time(sum(angles), *bounds)
    assert ideal <= total * (1 + 1e-12)
    assert total <= ideal * (1 + 1e-11)
    assert used_fraction(demands(angles, given), timings) <= 1


def test_pieces_meet_with_velocity_and_acceleration_at_nodes_and_breaks():
    angles = (2.0, 1.0)
    timings = cut_double_s(angles, 1.0, 2.0, 10.0)
    for k, tolerance in ((1, 1e-12), (2, 1e-10)):
        sides = [
            (
                angle * t.easing(tau, k, "left") / t.duration**k,
                angle * t.easing(tau, k, "right") / t.duration**k,
            )
            for angle, t in zip(angles, timings, strict=True)
            for tau in t.easing.breaks[1:-1]
        ]
        left, right = (angles[i] * timings[i].easing(1.0 - i, k) / timings[i].duration ** k for i in (0, 1))
        for a, b in [*sides, (left, right)]:
            assert a == pytest.approx(b, abs=tolerance)


@pytest.mark.parametrize(("degree", "continuity"), [(5, 2), (9, 2), (31, 2), (7, 3), (20, 3)])
def test_the_basis_meets_what_is_asked_at_both_ends(degree, continuity):
    rng = np.random.default_rng(degree)
    basis = PolynomialBasis(degree, continuity)
    left, right = rng.normal(size=(2, continuity + 1))
    easing = Profile.single(control_points(basis, left, rng.normal(size=basis.free), right))
    for i in range(continuity + 1):
        assert easing(0.0, i) == pytest.approx(left[i], abs=1e-9)
        assert easing(1.0, i) == pytest.approx(right[i], abs=1e-7)


@pytest.mark.parametrize(("degree", "continuity"), [(9, 2), (31, 2), (11, 3)])
def test_a_smoothstep_survives_the_way_into_the_basis_and_back(degree, continuity):
    basis = PolynomialBasis(degree, continuity)
    easing = Profile.single(smoothstep.control_points(continuity), continuity)
    rest = np.eye(continuity + 1)[0]
    back = basis.easing(0 * rest, basis.free_of(easing), rest)
    np.testing.assert_allclose(back(TAU, 3), easing(TAU, 3), atol=1e-9)


@pytest.mark.parametrize(("degree", "continuity", "pieces"), [(9, 2, 1), (20, 2, 2), (29, 3, 4)])
def test_an_easing_in_several_pieces_is_read_back_as_it_was_written(degree, continuity, pieces):
    """The solver begins where it is told: a high degree is kept in pieces, of which the first is not all."""
    rng = np.random.default_rng(degree)
    basis = PolynomialBasis(degree, continuity)
    left, right = rng.normal(size=(2, continuity + 1))
    free = rng.normal(size=basis.free)
    easing = basis.easing(left, free, right)
    assert len(easing.pieces) == pieces
    np.testing.assert_allclose(basis.free_of(easing), free, atol=1e-9)


def test_sides_of_a_break_and_the_domain():
    easing = Profile.from_control_points([0.0, 0.25, 1.0], ([0.0, 0.5], [0.5, 1.0]), 0)
    assert easing(0.25, 1, "left") == 2.0
    assert easing(0.25, 1, "right") == pytest.approx(2 / 3)
    assert easing(np.array([0.0, 0.25, 1.0])).tolist() == [0.0, 0.5, 1.0]
    with pytest.raises(ValueError, match="outside"):
        easing(1.0000001)


@pytest.mark.parametrize("factor", [0.2, 1.0, 7.0])
def test_the_stretch_is_exact_both_ways(factor):
    demanded = [demand(2.0, {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0})]
    timing = Timing(factor * 3.0, Profile.single(smoothstep.control_points(2)))
    fitted = fit_to_limits(demanded, [timing])
    assert fitted[0].duration == pytest.approx(smoothstep_duration(QUINTIC_PEAKS, 2.0, (1, 2, 10)), rel=1e-11)
    assert used_fraction(demanded, fitted) <= 1


def test_a_profile_leaves_its_callers_arrays_as_they_are():
    state, control = np.array([0.0, 0.5]), np.array([0.0, 0.2, 1.0])
    profile = Profile((Piece(1.0, state, control),))
    state[0], control[1] = 5.0, 5.0
    assert profile.pieces[0].state[0] == 0.0
    assert profile.pieces[0].control[1] == 0.2
    for array in (profile.breaks, profile.times, profile.pieces[0].state, profile.pieces[0].control):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


def test_time_that_cannot_be_stretched_to_the_limits_is_said(monkeypatch):
    """A law whose numbers are not finite stays beyond its limits whatever the time; nothing is returned for it."""
    broken = Timing(1.0, Profile.single([0.0, np.nan, 1.0]))
    with pytest.raises(InfeasibleError, match="no stretch of time brings the law within its limits"):
        fit_to_limits([demand(1.0, {"velocity": 1.0})], [broken])
    monkeypatch.setattr(time_scaling, "_find_fraction", lambda *_: 1.5)
    with pytest.raises(InfeasibleError, match=r"1\.5 of them is used at the end"):
        fit_to_limits([demand(1.0, {"velocity": 1.0})], [Timing(1.0, Profile.single([0.0, 1.0]))])
