"""Motions with given times or end rates: every feasible one has its law, every other one its reason and place."""

import numpy as np
import pytest

from timelaw import design
from timelaw.easing.family import PolynomialFamily
from timelaw.errors import Fault, InfeasibleError, InputError
from timelaw.nlp import single_runs
from timelaw.nlp.given_runs import solve_given

HEAD = "timelaw: 1\nname: given\n"
LIMITS = "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}\n"


def turns(*degrees):
    listing = ", ".join(f"[{d}, 0, 0]" for d in degrees)
    return (
        f"route: {{orientations: {{list: [{listing}], as: euler, sequence: XYZ, unit: deg}}, tour: given}}\n"
    )


def make(tmp_path, text):
    path = tmp_path / "p.yaml"
    path.write_text(HEAD + text)
    return design(path)


def proved(tmp_path, text):
    done = make(tmp_path, text)
    assert done.optimised.certificate.findings() == []
    return done.optimised.law


def on_its_arcs(law):
    t = np.linspace(0, 1, 400)
    return all(-1e-4 < f < 1 + 1e-4 for arc in law.legs for f in arc.profile(t) / arc.angle)


@pytest.mark.parametrize(
    "family", ["{basis: polynomial, degree: 9}", "{basis: spline, degree: 4, intervals: 50}"]
)
@pytest.mark.parametrize("end", ["start", "end"])
def test_a_motion_may_begin_or_end_at_the_limit(tmp_path, family, end):
    """90° from 60 deg/s to rest: 1.85 s by the double-S ramp, 1.5 s + half a ramp of 0.7 s."""
    law = proved(
        tmp_path, turns(0, 90) + LIMITS + f"nodes: {{{end}: {{velocity: 60 deg/s}}}}\neasing: {family}\n"
    )
    assert 1.85 <= law.duration < 1.885
    assert np.linalg.norm(law(0.0 if end == "start" else law.duration, 1)) == pytest.approx(
        np.pi / 3, rel=1e-10
    )
    assert on_its_arcs(law)


@pytest.mark.parametrize("limits", [LIMITS, "limits: {velocity: 60 deg/s}\n"])
def test_a_steady_turn_at_the_limit_takes_its_angle_over_the_limit(tmp_path, limits):
    ends = "nodes: {start: {velocity: 60 deg/s}, end: {velocity: 60 deg/s}}\n"
    law = proved(tmp_path, turns(0, 40, 90) + limits + ends)
    assert law.duration == pytest.approx(1.5, rel=1e-10)


def test_a_slower_steady_turn_gets_faster_between(tmp_path):
    ends = "nodes: {start: {velocity: 50 deg/s}, end: {velocity: 50 deg/s}}\n"
    assert 1.5 < proved(tmp_path, turns(0, 90) + LIMITS + ends).duration < 1.6


@pytest.mark.parametrize(
    ("given", "place", "reason"),
    [
        (
            "start: {velocity: 61 deg/s}",
            "nodes.start.velocity",
            "1.01667 times as much as the limit on the velocity",
        ),
        ("end: {velocity: 90 deg/s}", "nodes.end.velocity", "1.5 times as much as the limit on the velocity"),
        (
            "start: {velocity: 10 deg/s, acceleration: 130 deg/s^2}",
            "nodes.start.acceleration",
            "1.08333 times as much as the limit on the acceleration",
        ),
        (
            "at: {2: {time: 5 s}, 3: {time: 3 s}}",
            "nodes.at.3.time",
            "3 s: the body is at 2, earlier on the tour, until 5 s",
        ),
        ("at: {2: {time: 5 s, dwell: 2 s}, 3: {time: 6 s}}", "nodes.at.3.time", "until 7 s"),
        (
            "at: {2: {time: 5 s}}\nobjective: {minimise: jerk, total_time: 4 s}",
            "objective.total_time",
            "until 5 s",
        ),
    ],
)
def test_what_can_be_seen_to_be_wrong_is_wrong_input(tmp_path, given, place, reason):
    inner, _, rest = given.partition("\n")
    with pytest.raises(InputError) as error:
        make(tmp_path, turns(0, 40, 90) + LIMITS + f"nodes: {{{inner}}}\n{rest}\n")
    assert place in str(error.value)
    assert reason in str(error.value)
    assert ":4:" in str(error.value) or ":5:" in str(error.value) or ":6:" in str(error.value)


NINE = "easing: {degree: 9}\n"


def test_what_leaves_no_room_says_by_how_much(tmp_path):
    """Polynomials of degree 9 take 1.42425 s for 40°; the factor scales all three limits."""
    with pytest.raises(InfeasibleError, match=r"segments\.1-2\.duration") as error:
        make(tmp_path, turns(0, 40) + LIMITS + NINE + "segments: {1-2: {duration: 0.8 s}}\n")
    found = float(str(error.value).partition("would have to be ")[2].split()[0])
    scaled = {k: v * found for k, v in (("velocity", 60), ("acceleration", 120), ("jerk", 600))}
    units = ", ".join(
        f"{k}: {v!r} deg/s{p}" for (k, v), p in zip(scaled.items(), ("", "^2", "^3"), strict=True)
    )
    least = proved(tmp_path, turns(0, 40) + NINE + f"limits: {{{units}}}\n").duration
    assert least == pytest.approx(0.8, rel=1e-5)


REACHED = "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3, snap: 6000 deg/s^4}\n"


@pytest.mark.parametrize(
    ("given", "of", "reached"),
    [
        # v + a²/2j: 60 + 100/1200
        (
            "continuity: 3, start: {velocity: 60 deg/s, acceleration: 10 deg/s^2}",
            "acceleration",
            "60.0833333 deg/s of velocity",
        ),
        (
            "continuity: 3, start: {velocity: 48.1 deg/s, acceleration: 120 deg/s^2}",
            "acceleration",
            "60.1 deg/s of velocity",
        ),
        (
            "continuity: 3, end: {velocity: 60 deg/s, acceleration: -10 deg/s^2}",
            "acceleration",
            "60.0833333 deg/s of velocity",
        ),
        # a + j²/2s: 100 + 360000/12000
        (
            "continuity: 3, start: {velocity: 1 deg/s, acceleration: 100 deg/s^2, jerk: 600 deg/s^3}",
            "jerk",
            "130 deg/s\\^2 of acceleration",
        ),
    ],
)
def test_what_rises_beyond_a_limit_says_how_far(tmp_path, given, of, reached):
    end = "start" if "start" in given else "end"
    with pytest.raises(
        InfeasibleError, match=rf"nodes\.{end}\.{of}: under the limit on .*{reached} at least"
    ):
        make(tmp_path, turns(0, 90) + REACHED + f"nodes: {{{given}}}\n")


@pytest.mark.parametrize(
    "given",
    [
        "start: {velocity: 60 deg/s, acceleration: -10 deg/s^2}",
        "start: {velocity: 47 deg/s, acceleration: 120 deg/s^2}",
        "end: {velocity: 60 deg/s, acceleration: 10 deg/s^2}",
    ],
)
def test_what_rises_within_the_limits_has_its_law(tmp_path, given):
    proved(tmp_path, turns(0, 90) + LIMITS + f"nodes: {{{given}}}\n")


def test_what_cannot_brake_says_so_with_the_angle_it_takes(tmp_path):
    """v²/2a = 60²/(2 · 1) deg = 1800°."""
    limits = "limits: {velocity: 60 deg/s, acceleration: 1 deg/s^2}\n"
    with pytest.raises(InfeasibleError, match=r"nodes.start: slowing down takes 1800° at least .* has 90°"):
        make(tmp_path, turns(0, 90) + limits + "nodes: {continuity: 1, start: {velocity: 60 deg/s}}\n")


def test_where_no_law_stays_on_the_arc_one_beyond_it_is_found_and_said(tmp_path):
    done = make(tmp_path, turns(0, 9) + LIMITS + NINE + "nodes: {start: {velocity: 60 deg/s}}\n")
    assert done.optimised.certificate.findings() == []
    assert not on_its_arcs(done.optimised.law)
    assert "beyond a node" in done.solution.solutions[0].status.value


@pytest.mark.parametrize("rule", ["segments: {1-2: {duration: 30 s}}", "nodes: {at: {2: {time: 50 s}}}"])
def test_time_to_spend_is_not_spent_on_a_run_up(tmp_path, rule):
    for limits in (LIMITS, "limits: {jerk: 600 deg/s^3}\n"):
        assert on_its_arcs(proved(tmp_path, turns(0, 40, 90) + limits + rule + "\n"))


@pytest.mark.parametrize("factor", [1.0, 1 + 1e-13, 1 - 1e-13, 1 + 1e-7, 1.001])
def test_the_least_time_to_the_last_digit(tmp_path, factor):
    """90° take 2.2 s by the double-S, which a spline of degree 3 is."""
    time = 2.2 * factor
    text = turns(0, 90) + LIMITS + "easing: {basis: spline, degree: 3}\n"
    for rule in (
        f"objective: {{minimise: jerk, total_time: {time!r} s}}\n",
        f"segments: {{1-2: {{duration: {time!r} s}}}}\n",
    ):
        assert proved(tmp_path, text + rule).duration == pytest.approx(time, rel=1e-11)


def test_a_little_less_than_the_least_time_is_too_early(tmp_path):
    text = turns(0, 90) + LIMITS + "easing: {basis: spline, degree: 3}\n"
    with pytest.raises(InfeasibleError, match=r"2\.199999 s is too early for the end"):
        make(tmp_path, text + "objective: {minimise: jerk, total_time: 2.199999 s}\n")


@pytest.mark.parametrize(
    ("limits", "continuity", "possible"),
    [
        ("velocity: 1 rad/s", 1, 0),
        ("velocity: 1 rad/s, momentum: 9 N*m*s", 1, 0),
        ("acceleration: 1 rad/s^2", 2, 1),
        ("torque: 1 N*m", 2, 1),
        ("jerk: 1 rad/s^3", 3, 2),
        ("velocity: 1 rad/s, acceleration: 1 rad/s^2, jerk: 1 rad/s^3", 4, 2),
    ],
)
def test_a_double_s_is_refused_for_what_its_limits_cannot_give(tmp_path, limits, continuity, possible):
    body = "body: {inertia: [1 kg*m^2, 1 kg*m^2, 1 kg*m^2]}\n"
    text = turns(0, 90) + body + f"limits: {{{limits}}}\neasing: {{basis: double-s}}\n"
    with pytest.raises(InputError, match=f"easing.basis: .* continuity {possible}, not {continuity}"):
        make(tmp_path, text + f"nodes: {{continuity: {continuity}}}\n")
    if possible:
        assert proved(tmp_path, text + f"nodes: {{continuity: {possible}}}\n")


def test_auto_takes_what_every_run_can_do_although_it_looks_at_a_few(tmp_path, monkeypatch):
    """A short run that begins at speed among long ones, where no other family is made to find a law."""
    places = "[[0, 0, 0], [9, 0, 0], [9, 90, 0], [99, 90, 0], [99, 10, 0], [30, 10, 0], [30, 100, 0]]"
    route = f"route: {{orientations: {{list: {places}, as: euler, sequence: XYZ, unit: deg}}, tour: given}}\n"

    def solve(problem):
        if problem.family != PolynomialFamily(9, 2):
            raise InfeasibleError(Fault("no law"))
        return solve_given(problem)

    monkeypatch.setattr(single_runs, "solve_given", solve)
    done = make(tmp_path, route + LIMITS + "nodes: {start: {velocity: 10 deg/s}}\n")
    assert done.family == PolynomialFamily(9, 2)
    assert done.optimised.certificate.findings() == []
