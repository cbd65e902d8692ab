"""Certificates: what they prove, what they catch, and that nothing between samples escapes."""

import copy
import json
from dataclasses import replace
from math import comb
from pathlib import Path

import numpy as np
import pytest

from tests.cases import PROBLEMS, problem
from tests.oracles import extremum
from timelaw.certificate import certify
from timelaw.certificate.record import compare_with_record
from timelaw.compose import compose_law
from timelaw.easing import Profile
from timelaw.export import format_law
from timelaw.law_file.document import from_document
from timelaw.orientations import read_orientations
from timelaw.pipeline import design
from timelaw.requirements import resolve_requirements
from timelaw.route import lay_route
from timelaw.time_law.baselines import time_double_s
from timelaw.tours import find_tour

THETA = 2 * np.pi / 3


@pytest.fixture(scope="module")
def document(paper):
    return json.loads(format_law(paper.optimised.law, paper.optimised.certificate, {}))


def findings(document):
    certificate = certify(from_document(document))
    return certificate.findings(), compare_with_record(certificate, document)


def powers(piece, order):
    """Power-basis coefficients in u of d^k φ/dt^k on a piece, by Taylor and by integrating the highest rate."""
    n, h = len(piece.control) - 1, piece.duration
    top = np.zeros(n + 1)
    for i, c in enumerate(piece.control):
        for j in range(n - i + 1):
            top[i + j] += c * comb(n, i) * comb(n - i, j) * (-1) ** j
    for value in piece.state[::-1]:
        top = np.concatenate([[value], top * h / np.arange(1, len(top) + 1)])
    return np.polynomial.polynomial.polyder(top, order) / h**order


def test_peaks_equal_the_extrema_that_roots_give(paper):
    for entry in paper.laws:
        for order, check in enumerate(entry.certificate.limits, 1):
            tops = [extremum(powers(p, order)) for s in entry.law.segments for p in s.profile.pieces]
            assert check.peak == pytest.approx(max(tops), rel=1e-8)
            assert check.peak <= check.upper <= check.peak * (1 + 1e-9)


def test_no_sample_exceeds_what_was_proved_and_the_peak_is_where_it_says(paper):
    for entry in paper.laws:
        law = entry.law
        t = np.linspace(0, law.duration, 200001)
        for order, check in enumerate(entry.certificate.limits, 1):
            assert np.max(np.linalg.norm(law(t, order), axis=1)) <= check.upper
            around = np.clip(check.time + np.array([-1e-9, 1e-9]), 0, law.duration)  # it may lie at a jump
            at = np.max(np.linalg.norm(law(around, order), axis=1))
            assert at == pytest.approx(check.peak, rel=1e-6)
            assert check.holds
            assert check.margin >= 0


def test_a_limit_is_held_or_broken_without_tolerance(paper):
    law = paper.optimised.law
    for check in paper.optimised.certificate.limits:
        exact = replace(law, limits={**law.limits, check.limit: check.upper})
        below = replace(law, limits={**law.limits, check.limit: np.nextafter(check.upper, 0)})
        assert certify(exact).holds
        assert not certify(below).holds
        assert check.limit in certify(below).findings()[0]


def test_the_emitted_file_certifies_as_the_design_did(paper, document):
    assert findings(document) == ([], [])
    assert certify(from_document(document)).to_dict() == paper.optimised.certificate.to_dict()


def altered(document, change):
    changed = copy.deepcopy(document)
    change(changed["segments"])
    return changed


def set_control(segment, index, factor, key="bernstein"):
    def change(segments):
        control = segments[segment]["pieces"][0][key]
        control[index] = control[index] * factor + (1e-6 if key == "state" or control[index] == 0 else 0)

    return change


def scale(key, segment, factor):
    def change(segments):
        segments[segment][key] *= factor

    return change


def turn_axis(segment, angle):
    def change(segments):
        x, y, z = segments[segment]["axis"]
        c, s = np.cos(angle), np.sin(angle)
        segments[segment]["axis"] = [c * x - s * y, s * x + c * y, z]

    return change


ALTERATIONS = {
    **{f"control point {i}": set_control(4, i, 1 + 1e-6) for i in range(7)},
    **{f"state {i}": set_control(4, i, 1 + 1e-6, "state") for i in range(3)},
    **{f"duration of {i}": scale("duration", i, 1 + 1e-7) for i in range(11)},
    **{f"axis of {i}": turn_axis(i, 1e-6) for i in range(11)},
    "shorter": scale("duration", 0, 0.99),
    "angle": scale("angle", 2, 1 + 1e-7),
    "start time": scale("start_time", 3, 1 + 1e-9),
}


@pytest.mark.parametrize("name", ALTERATIONS)
def test_alterations_are_caught_and_not_by_the_digest_alone(document, name):
    changed = altered(document, ALTERATIONS[name])
    in_law, in_record = findings(changed)
    assert "the motion was altered after it was certified: its digest is another" in in_record
    assert len(in_law) + len(in_record) > 1


@pytest.mark.parametrize(
    "name", ["duration of 3", "axis of 5", "shorter", "angle", "start time", "control point 0"]
)
def test_some_alterations_break_the_law_itself(document, name):
    assert findings(altered(document, ALTERATIONS[name]))[0]


def test_the_smallest_alteration_changes_the_digest(document):
    def change(segments):
        control = segments[0]["pieces"][0]["bernstein"]
        control[4] = float(np.nextafter(control[4], 1))

    assert len(findings(altered(document, change))[1]) == 1


def test_numbers_may_be_written_otherwise(document):
    """1 for 1.0, as other programs write it, is the same file."""
    text = json.dumps(document).replace("1.0,", "1,").replace("0.0,", "0,")
    assert text != json.dumps(document)
    assert findings(json.loads(text)) == ([], [])


def test_a_law_without_record_is_certified_by_its_motion_alone(document):
    bare = {k: v for k, v in document.items() if k not in ("certificate", "nodes", "provenance")}
    assert findings(bare) == ([], [])


@pytest.mark.parametrize(
    ("key", "value", "finding"),
    [
        ("duration", 12.0, "the file gives a duration of 12.0 s"),
        ("nodes", [], "the nodes recorded in the file are not those of its motion"),
        ("certificate", {"continuity": 3}, 'the recorded certificate says otherwise about "continuity"'),
        ("certificate", {}, 'the recorded certificate says otherwise about "holds"'),
        ("certificate", "none", "the recorded certificate is no certificate"),
        ("nodes", [{}] * 12, "the nodes recorded in the file are not those of its motion"),
        ("continuity", 3, "the motion is C2, C3 was asked for"),
    ],
)
def test_false_claims_are_caught(document, key, value, finding):
    in_law, in_record = findings({**document, key: value})
    assert finding in " ".join([*in_law, *in_record])


def test_where_a_peak_is_may_be_told_otherwise_but_not_how_high_it_is(document):
    """Of equal peaks rounding decides which one is named: no reason to refuse a file on another machine."""

    def recorded(key, value):
        changed = copy.deepcopy(document)
        changed["certificate"]["limits"][2][key] = value
        return findings(changed)[1]

    assert recorded("time", 7.7) == []
    assert recorded("segment", "12–11") == []
    assert recorded("peak", 1.0) == ['the recorded certificate says otherwise about "limits"']


def test_a_jump_from_q_to_minus_q_is_found(document):
    """The same orientation, but samples of the quaternion would jump."""

    def change(segments):
        for key in ("start", "end"):
            segments[3][key] = [-c for c in segments[3][key]]

    assert any(
        "nodes are met: off by 6.28 rad of body rotation" in f for f in findings(altered(document, change))[0]
    )


def test_a_node_that_is_missed_is_found(document):
    def change(segments):
        segments[0]["end"] = [0.5, -0.5, -0.5, 0.5]

    found = findings(altered(document, change))[0]
    assert any("nodes are met: off by" in f and "at node 12" in f for f in found)


# Continuity


def test_the_quintics_jerk_jump_at_every_corner_has_its_closed_form(paper):
    """|60 (θ₂n₂/T₂³ − θ₁n₁/T₁³)|: the quintic's f''' is 60 at both ends of a leg."""
    entry = next(b for b in paper.baselines if b.name == "quintic")
    for node, before, after in zip(
        entry.certificate.continuity.nodes[1:-1], paper.route.legs, paper.route.legs[1:], strict=False
    ):
        expected = 60 * THETA / 3.75**3 * np.linalg.norm(after.axis - before.axis)
        assert node.jump["jerk"] == pytest.approx(expected, rel=1e-9, abs=1e-12)
        assert max(node.jump["omega"], node.jump["alpha"]) < 1e-14
        assert node.continuity == (2 if node.kind == "corner" else 3)
    ends = (entry.certificate.continuity.nodes[0], entry.certificate.continuity.nodes[-1])
    for node in ends:
        assert node.jump["jerk"] == pytest.approx(60 * THETA / 3.75**3, rel=1e-9)
    assert entry.certificate.continuity.order == 2


def test_nodes_are_classified_with_their_turns(paper):
    nodes = paper.optimised.certificate.continuity.nodes
    assert [n.kind for n in nodes] == [n.kind for n in paper.route.nodes]
    np.testing.assert_allclose([n.turn for n in nodes], [n.turn for n in paper.route.nodes], atol=1e-15)
    straight = [n for n in nodes if n.kind == "straight"]
    assert all(np.linalg.norm(n.before["omega"]) > 0.9 for n in straight)


def test_sides_agree_with_the_law(paper):
    law = paper.optimised.law
    for node in paper.optimised.certificate.continuity.nodes[1:-1]:
        for order, name in ((1, "omega"), (2, "alpha"), (3, "jerk")):
            np.testing.assert_allclose(node.before[name], law(node.time, order, "left"), atol=1e-9)
            np.testing.assert_allclose(node.after[name], law(node.time, order, "right"), atol=1e-9)


def test_continuity_3_has_no_jerk_jump(tmp_path):
    text = (PROBLEMS / "paper-24-cell.yaml").read_text().replace("continuity: 2", "continuity: 3")
    (tmp_path / "p.yaml").write_text(text)
    smooth = design(tmp_path / "p.yaml")
    report = smooth.optimised.certificate.continuity
    assert report.order == 3
    assert max(node.jump["jerk"] for node in report.nodes) < 1e-9
    assert smooth.optimised.certificate.holds


def test_jumps_inside_a_segment_count():
    """A double-S without a jerk limit jumps in α inside its legs; with velocity alone, ω jumps too."""
    report = certify(_double_s("{velocity: 60 deg/s, acceleration: 120 deg/s^2}")).continuity
    assert (report.inside, report.order) == (1, 1)
    assert certify(_double_s("{velocity: 60 deg/s}")).continuity.order == 0


def test_a_limit_cannot_hold_where_a_lower_rate_jumps():
    """A double-S without jerk limit jumps in α: whatever its pieces do, no jerk limit holds."""
    trapezoid = _double_s("{velocity: 60 deg/s, acceleration: 120 deg/s^2}")
    assert certify(trapezoid).holds
    found = certify(replace(trapezoid, limits={**trapezoid.limits, "jerk": 1e6})).findings()
    assert len(found) == 1
    assert found[0].startswith("alpha jumps at node")


def test_a_motion_that_starts_with_a_jolt_holds_no_acceleration_limit(paper):
    """f = τ has no acceleration inside, but an infinite one at both ends."""
    arc = _eased(paper.optimised.law.segments[0], [0.0, 1.0], duration=10.0)
    law = replace(paper.optimised.law, segments=(arc,), limits={"velocity": 1.0}, continuity=0)
    assert certify(law).holds
    assert not certify(replace(law, limits={"velocity": 1.0, "acceleration": 1e-3})).holds


def test_a_jump_is_judged_by_the_limit_or_by_what_the_motion_sustains(paper):
    """Not by the pieces that meet: what is cruised through has only rounding for an acceleration."""
    first, second = paper.optimised.law.segments[:2]
    quick = _eased(first, [0, 0, 0, 1, 1, 1.0], duration=1.0)
    calm = _eased(second, [0, 0, 1, 1.0], start_time=1.0, duration=100.0)
    free = replace(paper.optimised.law, segments=(quick, calm), limits={"velocity": 100.0}, continuity=0)
    report = certify(free).continuity
    jump = 6 * calm.angle / 1e4
    sustained = quick.angle * (120 / 7) ** 0.5  # root mean square of 60τ - 180τ² + 120τ³
    assert report.nodes[2].jump["alpha"] == pytest.approx(jump, rel=1e-12)
    assert report.nodes[2].parts[2] == pytest.approx(jump / sustained, rel=1e-12)
    assert report.nodes[2].continuity == 1
    for limit in (jump * 2, 1e3 * sustained):
        law = replace(free, limits={"acceleration": limit})
        assert certify(law).continuity.nodes[2].parts[2] == pytest.approx(jump / limit, rel=1e-12)
    beyond = certify(replace(free, limits={"acceleration": 1e9 * sustained})).continuity.nodes[2]
    assert beyond.parts[2] == pytest.approx(jump / (1e3 * sustained), rel=1e-12)


def test_pieces_that_do_not_meet_are_a_geometric_finding(paper):
    law = paper.optimised.law
    first = law.segments[0]
    torn = Profile.from_control_points([0.0, 0.5, 1.0], ([0.0, 0.4], [0.5, 1.0]), 0)
    torn = replace(first, profile=torn.scaled(first.angle, first.duration))
    broken = replace(law, segments=(torn, *law.segments[1:]))
    assert any("nodes are met: off by 0.209 rad" in f for f in certify(broken).findings())


def _eased(arc, control, **changes):
    """The arc run through by one polynomial, in another time."""
    arc = replace(arc, **changes)
    easing = Profile.single(control, min(2, len(control) - 2))
    return replace(arc, profile=easing.scaled(arc.angle, arc.duration))


def _double_s(limits):
    """The double-S law of the paper's tour under other limits."""
    spec = problem(f"limits: {limits}")
    points = read_orientations(spec.route.orientations, Path())
    way = lay_route(points, find_tour(spec, points))
    plan = resolve_requirements(spec, way)
    return compose_law("t", way, time_double_s(way, plan), plan)
