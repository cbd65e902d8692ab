"""Joints of Bézier curves: their classes with numbers, and where the body passes them at speed."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.curves import LINEAR, PLACES, RATES, TURNS, curve, evaluate, halves, make, read_given
from tests.test_bezier import example
from timelaw.bezier.joints import find_joints

BOTH = f"{RATES}, {LINEAR}"
DEFAULT = "baselines: []"


def test_numbers_of_joints_are_those_of_differences():
    """By SciPy's rotations and differences of the curves as the authors write them."""
    design = example()
    h = 1e-5
    for joint, before, after in zip(design.joints, design.curves, design.curves[1:], strict=False):
        rates, ways = [], []
        for one, u in ((before, np.array([1 - 2 * h, 1.0])), (after, np.array([0.0, 2 * h]))):
            q = evaluate(one.control, u)
            turn = Rotation.from_quat(q, scalar_first=True)
            rates.append((turn[0].inv() * turn[1]).as_rotvec() / (2 * h))
            place = evaluate(one.points, u) / np.sum(q**2, axis=1)[:, None]
            ways.append((place[1] - place[0]) / (2 * h))
        for (a, b), found, step in ((rates, joint.turn, joint.steps[0]), (ways, joint.bend, joint.steps[1])):
            angle = np.arccos(a @ b / np.linalg.norm(a) / np.linalg.norm(b))
            assert found == pytest.approx(angle, abs=1e-3)
            assert step[0] == pytest.approx(np.linalg.norm(b - a), rel=1e-3)


def joint_of(curves):
    (joint,) = find_joints(read_given(curves))
    return joint


def test_a_curve_cut_in_two_is_smooth_at_the_cut():
    even, uneven = joint_of(halves(0.5)), joint_of(halves(0.3))
    assert (even.parametric, even.geometric) == (3, 3)
    assert (uneven.parametric, uneven.geometric) == (0, 3)
    assert uneven.ratios == pytest.approx((3 / 7, 0, 0), abs=1e-9)
    assert uneven.turn == pytest.approx(0, abs=1e-7)
    assert uneven.curving == pytest.approx(0, abs=1e-9)


def test_an_origin_that_stands_still_but_for_rounding_has_no_direction():
    first, second = halves(0.3, 1.3, (TURNS, np.nextafter(PLACES[:1], [[9.0], [-9.0], [9.0], [9.0]])))
    joint = joint_of([first, second])
    assert (joint.geometric, joint.bend, joint.winding) == (3, None, None)
    assert joint_of(halves(0.3, 1.3, (TURNS, PLACES[:1] + 1e-9 * PLACES))).bend == pytest.approx(0, abs=1e-5)


def test_projective_weights_leave_the_path_and_change_its_parameter():
    """U = v/(v + c(1 - v)) with weights c^i: u' = c at v = 1... here β₁ = 3/7c and β₂ is not zero."""
    c = 1.3
    joint = joint_of(halves(0.3, c, (TURNS, None)))
    assert joint.geometric == 3
    assert joint.ratios[0] == pytest.approx(3 / 7 / c, rel=1e-9)
    assert abs(joint.ratios[1]) > 0.01


@pytest.mark.parametrize(
    ("continuity", "projective"),
    [
        pytest.param(1, 1.3, marks=pytest.mark.campaign),
        pytest.param(2, 1.0, marks=pytest.mark.campaign),
        (2, 1.3),
        (3, 1.3),
    ],
)
def test_a_smooth_joint_is_passed_at_speed(continuity, projective):
    curves = halves(0.3, projective, (TURNS, None))
    limits = RATES if continuity > 1 else "velocity: 60 deg/s, acceleration: 120 deg/s^2"
    more = f"nodes: {{continuity: {continuity}}}\n{DEFAULT}"
    through = make(curves, limits, more)
    assert through.passed == (True,)
    certificate = through.optimised.certificate
    assert certificate.findings() == []
    assert certificate.order >= continuity
    assert np.linalg.norm(certificate.continuity.nodes[1].before["omega"]) > 0.1
    stopping = make(
        curves, limits, f"nodes: {{continuity: {continuity}, at: {{2: {{stop: true}}}}}}\n{DEFAULT}"
    )
    assert stopping.passed == (False,)
    assert stopping.optimised.law.duration > 1.05 * through.optimised.law.duration


def test_places_pass_a_joint_too():
    design = make(halves(), BOTH)
    assert design.passed == (True,)
    certificate = design.optimised.certificate
    assert certificate.findings() == []
    assert certificate.translation.order >= 2
    law = design.optimised.law
    assert np.linalg.norm(law.place(law.times[1], 1)) > 0.1


def test_where_the_path_is_g1_only_the_body_stops_but_not_where_that_is_enough():
    turns = TURNS[:2]
    end = turns[1] + 0.4 * (turns[1] - turns[0])
    bent = np.array([turns[1], end, [0.1, 0.3, -0.2, 0.9]])
    curves = [curve(turns), curve(bent)]
    joint = joint_of(curves)
    assert (joint.parametric, joint.geometric) == (0, 1)
    assert joint.curving > 0.1
    assert make(curves).passed == (False,)
    through = make(curves, "velocity: 60 deg/s, acceleration: 120 deg/s^2", "nodes: {continuity: 1}")
    assert through.passed == (True,)
    assert through.optimised.certificate.findings() == []


SLOW = "velocity: [0.001 rad/s, 0.0004 rad/s, 0.0005 rad/s], linear_velocity: 1 m/s"


ONE, THREE = "{0} {1}", "[{0} {1}, {0} {1}, {0} {1}]"
MORE = [pytest.param(ONE, far, marks=pytest.mark.campaign) for far in (1e2, 1e6)]
MORE += [pytest.param(THREE, far, marks=pytest.mark.campaign) for far in (1e2, 1e6)]


@pytest.mark.parametrize(("form", "far"), [(ONE, 1e9), (THREE, 1e9), *MORE])
def test_limits_that_are_never_reached_change_nothing(form, far):
    """Whatever their scale: the search is not spoiled by rows a trillion times away from what they bound."""
    curves = halves(0.3, 1.3)
    units = {"acceleration": "rad/s^2", "jerk": "rad/s^3", "linear_acceleration": "m/s^2"}
    more = ", ".join(f"{name}: {form.format(far, unit)}" for name, unit in units.items())
    alone, together = make(curves, SLOW), make(curves, f"{SLOW}, {more}")
    assert together.optimised.certificate.findings() == []
    assert together.optimised.law.duration == pytest.approx(alone.optimised.law.duration, rel=1e-6)
    assert together.runs[0].found.choice.total < 0.8 * together.runs[0].found.begun


def test_a_search_begins_with_each_curve_in_its_own_least_time():
    """A curve that has to be slow does not slow the others, so that no law is slower than one that stops."""
    curves = halves(0.3)
    more = "segments: {{'{}': {{limits: {{velocity: 0.02 deg/s}}}}}}\nbaselines: [quintic]"
    for leg in ("1-2", "2-3"):
        design = make(curves, BOTH, more.format(leg))
        assert design.passed == (True,)
        assert design.runs[0].found.begun == pytest.approx(design.baselines[0].law.duration, rel=1e-3)
        assert design.optimised.law.duration < design.baselines[0].law.duration


POLYNOMIAL, SPLINE = "{basis: polynomial, degree: 11}", "{basis: spline, degree: 7, intervals: 12}"
FEW = [(4, POLYNOMIAL, 1e-6, 1e4), (4, SPLINE, 1.0, 1e6), (3, SPLINE, 1e-8, 0.0)]
SMALL_OR_FAR = [(1e-3, 0.0), (1e-6, 0.0), (1e-8, 0.0), (1.0, 1e3), (1.0, 1e6), (1e-6, 1e4)]
REST = [
    pytest.param(*case, marks=pytest.mark.campaign)
    for case in (
        (k, easing, *part) for k in (3, 4) for easing in (POLYNOMIAL, SPLINE) for part in SMALL_OR_FAR
    )
    if case not in FEW
]


@pytest.mark.parametrize(("continuity", "easing", "small", "far"), FEW + REST)
def test_curves_that_turn_by_little_or_far_from_the_origin_are_as_smooth_as_asked(
    continuity, easing, small, far
):
    """Their highest derivatives are differences of nearly equal numbers."""
    control = np.array([1.0, 0, 0, 0]) + small * np.random.default_rng(5).normal(size=(4, 4))
    more = f"nodes: {{continuity: {continuity}}}\neasing: {easing}\n{DEFAULT}"
    certificate = make([curve(control, PLACES + far)], BOTH, more).optimised.certificate
    assert certificate.findings() == []
    assert min(certificate.order, certificate.translation.order) >= continuity
