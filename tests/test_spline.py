"""Spline easings: SciPy's B-splines, the double-S limit over six decades, toppra under torque alone."""

import numpy as np
import pytest
from scipy.interpolate import BSpline

from tests.cases import AXIS, PROBLEMS, control_points, demand, demands, random_limits
from timelaw import design
from timelaw.certificate.jump_scale import JUMP_TOLERANCE
from timelaw.easing import Profile
from timelaw.easing.breaks import divide_breaks
from timelaw.easing.family import SplineFamily
from timelaw.easing.spline_basis import SplineBasis
from timelaw.easing.time_scaling import used_fraction
from timelaw.least_time.double_s import double_s_time
from timelaw.nlp import RunProblem, Status
from timelaw.nlp.single_runs import solve_run

DEG = np.pi / 180
REFERENCE = [(60, 120, 600), (1, 0.05, 0.01), (720, 2000, 100000), (10, 900, 90000)]
# degree, intervals, continuity: how near to the double-S profile. Measured: 2e-5, 8e-4, 3e-3 at worst.
FAMILIES = {(3, 50, 2): 5e-4, (4, 50, 2): 5e-3, (5, 70, 3): 1.2e-2}


@pytest.mark.parametrize(("degree", "continuity"), [(3, 2), (4, 2), (5, 3), (7, 4)])
def test_the_basis_is_that_of_b_splines(degree, continuity):
    rng = np.random.default_rng(degree)
    breaks = np.concatenate([[0.0], np.sort(rng.uniform(0.05, 0.95, 9)), [1.0]])
    basis = SplineBasis(degree, tuple(breaks), continuity)
    left, right = rng.normal(size=(2, continuity + 1))
    control = control_points(basis, left, rng.normal(size=basis.free), right).reshape(-1, degree + 1)
    easing = Profile.from_control_points(breaks, list(control), continuity)
    for k in range(continuity + 1):
        assert easing(0.0, k) == pytest.approx(left[k], rel=1e-6, abs=1e-6)
        assert easing(1.0, k) == pytest.approx(right[k], rel=1e-6, abs=1e-6)
    knots = np.concatenate([[0.0] * degree, breaks, [1.0] * degree])
    tau = np.linspace(0, 1, 500)
    # an interpolating B-spline through as many values as there are coefficients is the same curve
    sites = np.array([np.mean(knots[i + 1 : i + degree + 1]) for i in range(len(knots) - degree - 1)])
    matrix = BSpline.design_matrix(sites, knots, degree).toarray()
    same = BSpline(knots, np.linalg.solve(matrix, easing(sites)), degree)
    np.testing.assert_allclose(easing(tau), same(tau), rtol=1e-8, atol=1e-8)
    for k in range(degree):
        jumps = [easing(b, k, "right") - easing(b, k, "left") for b in breaks[1:-1]]
        np.testing.assert_allclose(jumps, 0, atol=1e-9 * 10 ** (2 * k))


def test_breaks_are_divided_alike_and_none_becomes_too_short():
    breaks = divide_breaks([0.0, 0.001, 0.2, 1.0], 31, 0.0005)
    assert {0.0, 0.001, 0.2, 1.0} <= set(breaks)
    assert len(breaks) == 32
    assert min(np.diff(breaks)) >= 0.0005 * (1 - 1e-9)


def check(angle, bounds, family):
    degree, intervals, continuity = family
    limits = dict(zip(("velocity", "acceleration", "jerk"), bounds, strict=True))
    legs = demands((angle,), limits)
    solution = solve_run(RunProblem(legs, SplineFamily(degree, intervals, continuity)))
    limit = double_s_time(angle, *bounds)
    assert solution.status is not Status.CLOSED_FORM
    assert used_fraction(legs, solution.timings) <= 1
    assert limit <= solution.duration * (1 + 1e-9)
    assert solution.duration <= limit * (1 + FAMILIES[family])


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("bounds", REFERENCE)
def test_splines_come_near_the_physical_limit_on_the_reference_sets(bounds, family):
    check(120 * DEG, tuple(b * DEG for b in bounds), family)


def check_random(seed, family):
    rng = np.random.default_rng(seed)
    bounds = tuple(random_limits(rng).values())
    check(float(10 ** rng.uniform(-1.5, 0.49)), bounds, family)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("seed", range(2))
def test_splines_come_near_the_physical_limit_over_six_decades(seed, family):
    check_random(seed, family)


@pytest.mark.campaign
@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("seed", range(3000, 4000))
def test_a_thousand_random_legs_come_near_the_physical_limit(seed, family):
    check_random(seed, family)


def test_splines_over_runs_pass_their_nodes_smoothly():
    limits = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}
    angles = (2.0, 0.5, 1.0)
    solution = solve_run(RunProblem(demands(angles, limits), SplineFamily(5, 60, 3)))
    assert solution.duration <= double_s_time(3.5, 1.0, 2.0, 10.0) * 1.01
    for k, most in enumerate(limits.values(), 1):
        ends = [
            a * t.easing(1.0, k, "left") / t.duration**k
            for a, t in zip(angles, solution.timings, strict=True)
        ]
        starts = [a * t.easing(0.0, k) / t.duration**k for a, t in zip(angles, solution.timings, strict=True)]
        np.testing.assert_allclose(ends[:-1], starts[1:], rtol=0, atol=JUMP_TOLERANCE * most)


@pytest.mark.parametrize(
    ("easing", "continuity", "label"),
    [
        ("{basis: spline, degree: 4, intervals: 40}", 2, "spline of degree 4 on 40 intervals"),
        ("{basis: spline}", 3, "spline of degree 5 on 50 intervals"),
        ("{basis: double-s}", 2, "double-S profile"),
        ("{basis: auto}", 2, "spline of degree 4 on 20 intervals"),
        ("{basis: auto, within: 5 %}", 2, "polynomial of degree 9"),
        ("{basis: auto, within: 0.1 %}", 2, "spline of degree 4 on 28 intervals"),
    ],
)
def test_easings_named_in_the_file_are_designed_and_certified(tmp_path, easing, continuity, label):
    text = (PROBLEMS / "paper-24-cell.yaml").read_text()
    text = text.replace("{basis: polynomial, degree: 9}", easing).replace(
        "continuity: 2", f"continuity: {continuity}"
    )
    (tmp_path / "p.yaml").write_text(text)
    designed = design(tmp_path / "p.yaml")
    assert designed.family.label == label
    assert designed.optimised.certificate.findings() == []
    assert designed.optimised.certificate.continuity.order == continuity


# Torque alone, against toppra: a path, its constraints, and a parametrisation that shares no code


def toppra_duration(angle, inertia, bound, gridpoints):
    toppra = pytest.importorskip("toppra")
    toppra.setup_logging("ERROR")
    path = toppra.SplineInterpolator([0.0, 0.5, 1.0], np.outer([0.0, 0.5, 1.0], angle * AXIS))

    def torque(_, omega, alpha):
        return inertia @ alpha + np.cross(omega, inertia @ omega)

    limits = np.stack([-np.array(bound), np.array(bound)], axis=1)
    constraint = toppra.constraint.JointTorqueConstraint(torque, limits, np.zeros(3))
    algorithm = toppra.algorithm.TOPPRA(
        [constraint], path, gridpoints=np.linspace(0, 1, gridpoints), solver_wrapper="seidel"
    )
    return algorithm.compute_trajectory().duration


@pytest.mark.filterwarnings("ignore")  # toppra's own, of the packages it stands on
def test_torque_alone_agrees_with_toppra_as_the_easing_is_refined():
    inertia, bound = np.array([[12.0, 1.0, -0.5], [1.0, 10.0, 0.7], [-0.5, 0.7, 8.0]]), (4.0, 3.0, 5.0)
    coarse, fine = (toppra_duration(2.0, inertia, bound, n) for n in (501, 2001))
    grid_error = abs(coarse / fine - 1) + 1e-4
    leg = demand(2.0, {"torque": bound}, AXIS, inertia)
    durations = []
    for intervals in (12, 48, 192):
        solution = solve_run(RunProblem((leg,), SplineFamily(3, intervals, 1)))
        assert used_fraction([leg], solution.timings) <= 1
        durations.append(solution.duration)
    assert durations[0] > durations[1] > durations[2] >= fine * (1 - grid_error)
    assert durations[2] <= fine * 1.005
