"""Problems that once got a wrong answer, each with the right one: steps about one axis, legs cruised through, smooth splines."""

import numpy as np
import pytest

from timelaw import design
from timelaw.certificate import certify
from timelaw.law_file.document import from_document, to_document

DEG = np.pi / 180
ROBOT = "{velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}"
SPACECRAFT = "{velocity: 1 deg/s, acceleration: 0.05 deg/s^2, jerk: 0.01 deg/s^3}"


def turns(*degrees):
    listing = ", ".join(f"[{d!r}, 0, 0]" for d in degrees)
    return f"{{orientations: {{list: [{listing}], as: euler, sequence: XYZ, unit: deg}}, tour: given}}"


def proved(tmp_path, route, limits, easing, continuity=2):
    path = tmp_path / "p.yaml"
    path.write_text(
        f"timelaw: 1\nname: right\nroute: {route}\nlimits: {limits}\neasing: {easing}\n"
        f"nodes: {{continuity: {continuity}}}\n"
    )
    done = design(path)
    certificate = done.optimised.certificate
    assert certificate.findings() == []
    assert certificate.continuity.order >= continuity
    assert max(certificate.continuity.worst.values()) <= 1e-9
    assert certify(from_document(to_document(done.optimised.law))).to_dict() == certificate.to_dict()
    return done


DOUBLE_S, SPLINE_3, SPLINE_4 = (
    "{basis: double-s}",
    "{basis: spline, degree: 3, intervals: 50}",
    "{basis: spline, degree: 4, intervals: 50}",
)


@pytest.mark.parametrize("easing", [DOUBLE_S, SPLINE_3])
def test_two_equal_steps(tmp_path, easing):
    """20° without reaching 60 deg/s: ramps of jerk 0.2 s, T = 0.2 + √(0.04 + 4 · 20/120)."""
    law = proved(tmp_path, turns(0, 10, 20), ROBOT, easing).optimised.law
    assert law.duration == pytest.approx(0.2 + np.sqrt(0.04 + 4 * 20 / 120), rel=1e-10)


@pytest.mark.parametrize("off", [1e-12, 1e-10, 1e-8])
@pytest.mark.parametrize("easing", [DOUBLE_S, SPLINE_4])
def test_two_nearly_equal_steps(tmp_path, off, easing):
    """Ramps of jerk 0.2 s again, T = 0.2 + √(0.04 + 4 · 10/120)."""
    law = proved(tmp_path, turns(0, 5, 10 + off / DEG), ROBOT, easing).optimised.law
    assert law.duration == pytest.approx(
        0.2 + np.sqrt(0.04 + 4 * 10 / 120), rel=1e-7 if easing == DOUBLE_S else 5e-4
    )


def test_steps_with_nine_typed_digits(tmp_path):
    law = proved(tmp_path, turns(0, 5.00000001, 10), ROBOT, SPLINE_4).optimised.law
    assert law.duration == pytest.approx(0.2 + np.sqrt(0.04 + 4 * 10 / 120), rel=5e-4)


def test_two_quarter_turns_without_a_velocity_limit(tmp_path):
    list_ = "{orientations: {list: [[1,0,0,0],[0.7071068,0.7071068,0,0],[0,1,0,0]]}, tour: given}"
    done = proved(tmp_path, list_, "{acceleration: 120 deg/s^2, jerk: 600 deg/s^3}", DOUBLE_S)
    assert done.optimised.law.duration == pytest.approx(0.2 + np.sqrt(0.04 + 4 * 180 / 120), rel=1e-6)


@pytest.mark.parametrize(("limits", "time"), [(ROBOT, 82.70), (SPACECRAFT, 4673.0)])
@pytest.mark.parametrize(("easing", "within"), [(DOUBLE_S, 1e-11), (SPLINE_4, 2e-5)])
def test_legs_that_are_cruised_through(tmp_path, limits, time, easing, within):
    route = "{orientations: {lattice: 600-cell}, tour: fewest-stops}"
    done = proved(tmp_path, route, limits, easing)
    assert done.optimised.law.duration == pytest.approx(time, rel=within)
    assert any(np.ptp(leg.profile(np.linspace(0, 1, 9), 1)) < 1e-12 for leg in done.laws[2].law.legs)


@pytest.mark.parametrize(("degree", "intervals"), [(5, 5), (6, 12), (7, 40)])
@pytest.mark.parametrize(
    "limits", ["{acceleration: 1 rad/s^2, jerk: 1000 rad/s^3}", "{velocity: 1e-3 rad/s, jerk: 1e5 rad/s^3}"]
)
def test_splines_of_continuity_4_under_limits_far_apart(tmp_path, degree, intervals, limits):
    easing = f"{{basis: spline, degree: {degree}, intervals: {intervals}}}"
    proved(tmp_path, "{orientations: {list: [[1,0,0,0],[.5,.5,.5,.5]]}}", limits, easing, 4)


@pytest.mark.parametrize("tiny", [1.0, 0.002])
@pytest.mark.parametrize(
    ("easing", "continuity", "within"),
    [
        (SPLINE_4, 2, 1e-4),
        ("{basis: spline, degree: 5, intervals: 70}", 3, 2e-3),
        ("{basis: polynomial}", 2, 0.05),
    ],
)
def test_a_tiny_leg_in_a_run_costs_nothing(tmp_path, tiny, easing, continuity, within):
    """60° + tiny + 50° in one run: as fast as 110° and a little in two legs."""
    done = proved(tmp_path, turns(0, 60, 60 + tiny, 110 + tiny), ROBOT, easing, continuity)
    limit = (110 + tiny) / 60 + 0.7
    assert done.optimised.law.duration == pytest.approx(limit, rel=within)


def test_phases_of_any_length_are_written_exactly(tmp_path):
    """A jerk phase of 1e-9 of the leg: constant jerk on seven durations, no least length of a phase."""
    limits = "{velocity: 1 rad/s, acceleration: 1 rad/s^2, jerk: 1e8 rad/s^3}"
    law = proved(tmp_path, turns(0, 100), limits, DOUBLE_S).optimised.law
    (leg,) = law.legs
    assert len(leg.profile.pieces) == 7
    assert [len(piece.control) for piece in leg.profile.pieces] == [1] * 7
    assert leg.profile.pieces[0].duration == pytest.approx(1e-8, rel=1e-9)
    assert law.duration == pytest.approx(100 * DEG + 1 + 1e-8, rel=1e-11)
