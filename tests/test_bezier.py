"""Motions along Bézier curves: emitted laws against the curves themselves, joints, toppra, near-cusps, limits."""

from functools import cache

import numpy as np
import pytest
from scipy.interpolate import BPoly
from scipy.spatial.transform import Rotation

from tests.cases import PROBLEMS
from tests.curves import LINEAR, PLACES, RATES, TURNS, curve, evaluate, halves, make, read_given
from timelaw.bezier.read import read_curves
from timelaw.certificate import certify
from timelaw.law_file import from_document, to_document
from timelaw.least_time.double_s import double_s_time
from timelaw.pipeline_bezier import design_curves
from timelaw.problem import load_problem

BOTH = f"{RATES}, {LINEAR}"
DEFAULT = "baselines: []"
SPLINE = "easing: {basis: spline, degree: 4, intervals: 10}"
CURVES = {
    "plain": [(TURNS, PLACES, "plain")],
    "divided": [(TURNS, PLACES, "divided")],
    "of other degrees": [(TURNS[:3], PLACES[[0, 2]], "divided")],
    "turning alone": [(TURNS, None, "plain")],
}


@cache
def designed(name, more=""):
    given = CURVES[name]
    limits = RATES if given[0][1] is None else BOTH
    return make([curve(*parts) for parts in given], limits, more)


@cache
def example():
    problem, source = load_problem(PROBLEMS / "hajsen-zmazek.yaml")
    return design_curves(PROBLEMS / "hajsen-zmazek.yaml", problem, source)


def locate(design, t):
    """u at times of a design of one curve, from its easings."""
    (timing,) = design.timings
    return np.array([timing.easing(x / timing.duration) for x in t])


@pytest.mark.parametrize(
    ("name", "more"),
    [*((name, "") for name in CURVES), ("divided", SPLINE), ("plain", "nodes: {continuity: 3}")],
)
def test_the_law_is_the_curve_in_its_time(name, more):
    """Orientation and place are those of Q(f(t)) and its points, evaluated by powers; rates their differences."""
    design = designed(name, more)
    law = design.optimised.law
    assert design.optimised.certificate.findings() == []
    ((control, points, translation),) = CURVES[name]
    t = np.linspace(0, law.duration, 203)[1:-1]
    u, step = locate(design, t), 1e-4 * law.duration
    q = evaluate(control, u)
    np.testing.assert_allclose(law(t), q / np.linalg.norm(q, axis=1)[:, None], atol=1e-12)
    turn = lambda s: Rotation.from_quat(law(s), scalar_first=True)  # noqa: E731
    omega = (turn(t - step).inv() * turn(t + step)).as_rotvec() / (2 * step)
    np.testing.assert_allclose(law(t, 1), omega, atol=1e-5 * np.max(np.abs(omega)))
    if points is None:
        return
    square = np.sum(q**2, axis=1)[:, None] if translation == "divided" else 1.0
    np.testing.assert_allclose(law.place(t), evaluate(points, u) / square, atol=1e-12)
    speed = (law.place(t + step) - law.place(t - step)) / (2 * step)
    np.testing.assert_allclose(law.place(t, 1), speed, atol=1e-5 * np.max(np.abs(speed)))
    gained = (law.place(t + step, 1) - law.place(t - step, 1)) / (2 * step)
    np.testing.assert_allclose(law.place(t, 2), gained, atol=1e-4 * np.max(np.abs(gained)))


@pytest.mark.parametrize("name", ["divided", "plain"])
def test_no_rate_jumps_by_more_than_rounding_of_itself(name):
    """Rounded one by one, places of degree 36 in ten pieces make the acceleration jump by 2e-12 of it."""
    design = designed(name, SPLINE)
    (segment,) = design.optimised.law.segments
    breaks = segment.breaks[1:-1]
    assert len(breaks) >= 9
    for value in (segment, segment.place):
        for order in (1, 2):
            right, left = (value(breaks, order, side) for side in ("right", "left"))
            assert np.max(np.abs(right - left)) <= 1e-14 * np.max(np.abs(right))


@pytest.mark.parametrize("name", CURVES)
def test_limits_hold_for_samples_too_and_some_are_reached(name):
    design = designed(name)
    law = design.optimised.law
    t = np.linspace(0, law.duration, 3001)
    found = {"velocity": law(t, 1), "acceleration": law(t, 2), "jerk": law(t, 3)}
    if law.travels:
        found |= {"linear_velocity": law.place(t, 1), "linear_acceleration": law.place(t, 2)}
    used = {k: np.max(np.linalg.norm(v, axis=1)) / law.limits[k] for k, v in found.items()}
    assert max(used.values()) == pytest.approx(1, abs=1e-4)
    for check in design.optimised.certificate.limits:
        assert used[check.limit] <= check.ratio + 1e-12
        assert check.ratio <= used[check.limit] + 1e-3


def test_u_never_runs_back():
    for more in ("", SPLINE):
        (timing,) = designed("divided", more).timings
        slope = timing.easing(np.linspace(0, 1, 5001), 1)
        assert np.min(slope) > -1e-9


def test_the_optimised_law_beats_the_quintic_and_splines_beat_a_polynomial():
    for name in CURVES:
        law, quintic = designed(name).laws
        assert law.law.duration < quintic.law.duration
        assert quintic.certificate.limits_hold
    assert designed("divided", SPLINE).optimised.law.duration < designed("divided").optimised.law.duration


def test_limits_that_suit_a_slower_time_give_it():
    """(w, a, j, v, b) → (2w, 4a, 8j, 2v, 4b) halves the time."""
    fast = make(
        [curve(TURNS, PLACES)],
        "velocity: 120 deg/s, acceleration: 480 deg/s^2, jerk: 4800 deg/s^3, "
        "linear_velocity: 4 m/s, linear_acceleration: 12 m/s^2",
    )
    assert designed("plain").optimised.law.duration == pytest.approx(
        2 * fast.optimised.law.duration, rel=1e-5
    )


@pytest.mark.parametrize("limit", ["linear_velocity: 0.3 m/s", "linear_acceleration: 0.2 m/s^2"])
def test_each_linear_limit_bites(limit):
    slow = make([curve(TURNS, PLACES)], f"{RATES}, {limit}").optimised
    assert slow.certificate.limits[-1].ratio == pytest.approx(1, abs=1e-6)
    free = make([curve(TURNS, PLACES)]).optimised.law
    assert certify(from_document({**to_document(free), "limits": dict(slow.law.limits)})).findings()


def test_a_great_circle_takes_what_an_arc_takes():
    """Two control quaternions are an arc on S³: no law is below the double-S, high degrees come near to it."""
    half = np.radians(40)
    two = np.array([[1.0, 0, 0, 0], [np.cos(half), np.sin(half) * 0.6, 0, np.sin(half) * 0.8]])
    limits = np.radians([60, 120, 600])
    least = double_s_time(2 * half, *limits)
    times = [
        make([curve(two)], more=f"easing: {easing}").optimised.law.duration
        for easing in ("{degree: 9}", "{degree: 13}", "{basis: spline, degree: 3, intervals: 30}")
    ]
    assert least <= min(times)
    assert times[0] > times[1] > times[2]
    assert times[2] < 1.01 * least


@pytest.mark.filterwarnings("ignore")  # toppra's own, of the packages it stands on
def test_the_least_time_of_a_translation_is_toppras():
    """By axis, velocity and acceleration alone: toppra solves that to the grid, whatever the easing."""
    ta = pytest.importorskip("toppra")
    ta.setup_logging("ERROR")
    points = np.array([[0, 0, 0], [1.0, 2, 0], [2, -1, 1], [3, 0, 0.5]])

    class Way(ta.interpolator.AbstractGeometricPath):
        dof, path_interval, waypoints = 3, np.array([0.0, 1.0]), None

        def __call__(self, u, order=0):
            return BPoly(points[:, None, :], [0, 1])(u, nu=order)

    bounds = [
        ta.constraint.JointVelocityConstraint(np.array([[-1.0, 1.0]] * 3)),
        ta.constraint.JointAccelerationConstraint(np.array([[-2.0, 2.0]] * 3)),
    ]
    algorithm = ta.algorithm.TOPPRA(bounds, Way(), gridpoints=np.linspace(0, 1, 1001))
    least = algorithm.compute_trajectory().duration
    limits = "linear_velocity: [1 m/s, 1 m/s, 1 m/s], linear_acceleration: [2 m/s^2, 2 m/s^2, 2 m/s^2]"
    still = np.array([[1.0, 0, 0, 0]] * 2)
    times = [
        make(
            [curve(still, points)], limits, f"nodes: {{continuity: 1}}\neasing: {easing}"
        ).optimised.law.duration
        for easing in ("{degree: 13}", "{basis: spline, degree: 3, intervals: 24}")
    ]
    assert least * (1 - 1e-3) < times[1] < times[0]
    assert times[1] < 1.007 * least
    assert times[0] < 1.025 * least


def about_x(*angles):
    half = np.radians(angles) / 2
    return np.stack([np.cos(half), np.sin(half), 0 * half, 0 * half], axis=1)


CUSPS = {
    "nearly": about_x(0, 100, -40, 60) + np.outer([0, 1, 1, 0], [0, 0, 2e-3, 0]),
    "there and back": about_x(0, 120, 0),
    "twice": about_x(0, 60, 60, 0),
}


@pytest.mark.parametrize("more", ["", pytest.param(SPLINE, marks=pytest.mark.campaign)])
@pytest.mark.parametrize("name", CUSPS)
def test_limits_hold_where_the_curves_own_speed_vanishes(name, more):
    design = make([curve(CUSPS[name])], more=more)
    speeds = np.linalg.norm(design.curves[0].turning(np.linspace(0, 1, 4001), 1)[0], axis=1)
    assert np.min(speeds) < 2e-3 * np.max(speeds)
    law, certificate = design.optimised.law, design.optimised.certificate
    assert certificate.findings() == []
    assert max(check.ratio for check in certificate.limits) > 1 - 1e-5
    t = np.linspace(0, law.duration, 3001)
    for order, name_ in enumerate(("velocity", "acceleration", "jerk"), 1):
        assert np.max(np.linalg.norm(law(t, order), axis=1)) <= law.limits[name_] * (1 + 1e-12)


def test_limits_hold_where_the_origins_speed_nearly_vanishes():
    points = [[0, 0, 0], [1.001, 1, 0], [0, 1, 0], [1, 0, 0]]  # three control points more and it is a cusp
    design = make([curve(TURNS[:2], points)], BOTH)
    speeds = np.linalg.norm(design.curves[0].place(np.linspace(0, 1, 4001), 1)[1], axis=1)
    assert np.min(speeds) < 2e-3 * np.max(speeds)
    assert design.optimised.certificate.findings() == []


def test_the_worked_example_is_the_authors():
    """Its control quaternions and points, from axis and angle by hand, and its joints, which are C0 only."""
    design = example()
    first = design.curves[0]
    r = np.sqrt(0.5)
    axis = np.array([1, 0, -1]) * r * np.sin(np.radians(67.5))
    by_hand = [[1, 0, 0, 0], [r, -r, 0, 0], [r, 0, 0, -r], [np.cos(np.radians(67.5)), *axis]]
    np.testing.assert_allclose(first.control, by_hand, atol=1e-15)
    np.testing.assert_array_equal(first.points, [[-9, -9, -9], [6, 2, 5], [-8, 6, 9], [5, 5, -5]])
    assert [joint.parametric for joint in design.joints] == [0, 0]
    assert [joint.geometric for joint in design.joints] == [0, 0]
    assert design.passed == (False, False)
    assert design.optimised.certificate.findings() == []
    assert design.optimised.law.shape == (1.0, 1.5, 2.0)
    np.testing.assert_allclose(
        design.optimised.law.place([0.0, design.optimised.law.duration]),
        [[-9, -9, -9], [0, 0, 0]],
        atol=1e-12,
    )


# Other limits, dwells, signs


def test_torque_is_eulers_along_a_curve():
    body = "body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2]}\nnodes: {continuity: 1}"
    design = make([curve(TURNS)], "torque: [5 N*m, 4 N*m, 3 N*m], momentum: 9 N*m*s", body)
    law = design.optimised.law
    assert design.optimised.certificate.findings() == []
    t, inertia = np.linspace(0, law.duration, 4001), np.diag([12.0, 10.0, 8.0])
    momentum = law(t, 1) @ inertia
    torque = law(t, 2) @ inertia + np.cross(law(t, 1), momentum)
    used = np.max(np.abs(torque) / [5, 4, 3])
    assert 0.99 < max(used, np.max(np.linalg.norm(momentum, axis=1)) / 9) <= 1


def test_wheels_with_momentum_are_kept_within_their_limits():
    body = (
        "body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2], actuator: wheels, "
        "momentum: [1 N*m*s, 2 N*m*s, 0.5 N*m*s]}\nnodes: {continuity: 1}"
    )
    design = make([curve(TURNS)], "torque: 5 N*m, momentum: [9 N*m*s, 9 N*m*s, 9 N*m*s]", body)
    assert design.optimised.certificate.findings() == []
    assert max(c.ratio for c in design.optimised.certificate.limits) > 0.999


def test_dwells_and_limits_of_single_curves():
    more = "nodes: {dwell: 0.5 s, at: {1: {dwell: 0 s}}}\nsegments: {1-2: {limits: {velocity: 10 deg/s}}}"
    design = make(halves(), BOTH, more)
    law = design.optimised.law
    assert [s.kind for s in law.segments] == ["rational", "dwell", "rational", "dwell"]
    assert design.optimised.certificate.findings() == []
    t = np.linspace(0, law.segments[0].duration, 4001)[:-1]
    assert np.degrees(np.max(np.linalg.norm(law(t, 1), axis=1))) == pytest.approx(10, rel=1e-3)
    np.testing.assert_array_equal(law.place(law.times[1]), law.place(law.times[2]))


def test_forms_of_control_quaternions_give_one_curve():
    turns = Rotation.from_quat(TURNS, scalar_first=True)
    vectors = turns.as_rotvec(degrees=True)
    angles = np.linalg.norm(vectors, axis=1)
    forms = [
        f"{{quaternions: {TURNS.tolist()}}}",
        f"{{as: xyzw, quaternions: {TURNS[:, [1, 2, 3, 0]].tolist()}}}",
        f"{{as: rotation-vector, unit: deg, quaternions: {vectors.tolist()}}}",
        f"{{as: matrix, quaternions: {turns.as_matrix().tolist()}}}",
        f"{{as: euler, unit: deg, sequence: ZYX, quaternions: {turns.as_euler('ZYX', degrees=True).tolist()}}}",
        f"{{as: axis-angle, unit: deg, quaternions: {np.column_stack([vectors + 0.0, angles]).tolist()}}}",
    ]
    first, *others = (read_given([form])[0].control for form in forms)
    for other in others:
        np.testing.assert_allclose(other, first, atol=1e-12)


def test_signs_are_kept_as_given_and_chosen_near_otherwise():
    turned = TURNS * [[1], [-1], [1], [1]]
    kept = read_given([f"{{quaternions: {turned.tolist()}}}"])[0].control
    np.testing.assert_allclose(kept, turned, atol=1e-15)
    matrices = Rotation.from_quat(turned, scalar_first=True).as_matrix().tolist()
    chosen = read_given([f"{{as: matrix, quaternions: {matrices}}}"])[0].control
    assert np.all(np.sum(chosen[1:] * chosen[:-1], axis=1) > 0)
    two = [f"{{quaternions: {TURNS.tolist()}}}", f"{{quaternions: {(-TURNS[::-1]).tolist()}}}"]
    np.testing.assert_allclose(read_given(two)[1].control, TURNS[::-1], atol=1e-15)


def test_reading_the_problem_file_leaves_ends_that_meet():
    problem, _ = load_problem(PROBLEMS / "hajsen-zmazek.yaml")
    for before, after in zip(read_curves(problem), read_curves(problem)[1:], strict=False):
        np.testing.assert_array_equal(before.control[-1], after.control[0])
