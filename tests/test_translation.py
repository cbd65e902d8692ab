"""The origin's way in a law: rates against 40 digits, proved limits, gaps, jumps, refusals, samples."""

import json
from copy import deepcopy
from functools import partial
from math import comb

import mpmath
import numpy as np
import pytest

from tests.test_rational import make_curve, make_law
from timelaw.certificate import certify
from timelaw.certificate.record import compare_with_record
from timelaw.errors import InputError
from timelaw.export import format_law, format_samples
from timelaw.law_file import from_document, to_document
from timelaw.limits.formula import LINEAR as LINEAR_KEYS
from timelaw.motion.origin_curve import HIGHEST_LIMITED, OriginCurve, derive_origins
from timelaw.motion.quaternion_curve import stack_curves

RNG = np.random.default_rng(12)
LIMITS = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}
FIRST, LAST = [1.0, -2.0, 0.5], [2.0, 1.0, 0.0]
LINEAR = {"linear_velocity": 5.0, "linear_acceleration": 20.0}


def bernstein(points, u):
    n = len(points) - 1
    return mpmath.fsum(
        comb(n, i) * u**i * (1 - u) ** (n - i) * mpmath.mpf(float(p)) for i, p in enumerate(points)
    )


def place(curve, t):
    """Σ points·B/|Q|² at an instant, as the law file defines it."""
    u = t / mpmath.mpf(curve.turn.duration)
    square = mpmath.fsum(bernstein(column, u) ** 2 for column in curve.turn.control.T)
    return [bernstein(column, u) / square for column in curve.points.T]


@pytest.mark.parametrize("seed", range(8))
def test_rates_of_the_origin_are_derivatives_of_its_place(seed):
    rng = np.random.default_rng(seed)
    turn = make_curve(rng, degree=int(rng.integers(1, 9)))
    curve = OriginCurve(rng.normal(size=(int(rng.integers(1, 12)), 3)), turn)
    (stack,) = stack_curves([turn])
    numerators, square = derive_origins([curve], stack.form), stack.form.power(1).list_rows()[0]
    for u in (0.1, 0.6):
        t, at = mpmath.mpf(u) * mpmath.mpf(turn.duration), np.array([u])
        for order in range(4):
            with mpmath.workdps(60):
                exact = [float(mpmath.diff(lambda s, i=i: place(curve, s)[i], t, order)) for i in range(3)]
            size = np.linalg.norm(exact) + turn.duration**-order
            assert np.linalg.norm(curve(at, order)[0] - exact) < 1e-10 * size
            if 0 < order <= HIGHEST_LIMITED:
                formula = [
                    p(at)[0] / square(at)[0] ** (order + 1)
                    for p in (part.list_rows()[0] for part in numerators[LINEAR_KEYS[order]])
                ]
                assert np.linalg.norm(np.subtract(formula, exact)) < 1e-10 * size


def moving(points=None, limits=None, **more):
    """A law of one rational segment from rest to rest, whose origin moves so too."""
    document = make_law(limits=limits or {**LIMITS, **LINEAR})
    document["segments"][0]["pieces"][0]["points"] = points or [FIRST] * 3 + [LAST] * 3
    return document | more


def two_legs(gap=0.0, points=None):
    """There and back."""
    document = moving()
    (first,) = document["segments"]
    back = deepcopy(first)
    back |= {"from": "2", "to": "3", "start_time": 4.0, "start": first["end"], "end": first["start"]}
    (piece,) = back["pieces"]
    piece["control"] = piece["control"][::-1]
    piece["points"] = points or piece["points"][::-1]
    piece["points"][:3] = [[x + gap for x in piece["points"][0]]] * 3
    return document | {"segments": [first, back], "duration": 8.0}


def test_a_law_with_a_translation_is_read_written_evaluated_and_certified():
    document = moving(body={"shape": [1.0, 1.5, 2.0]})
    law = from_document(document)
    assert law.travels
    assert law.shape == (1.0, 1.5, 2.0)
    written = to_document(law)
    assert written["segments"] == document["segments"]
    assert written["body"] == document["body"]
    certificate = certify(law)
    assert certificate.findings() == []
    assert certificate.order == 2
    np.testing.assert_allclose(law.place([0.0, 4.0]), [FIRST, LAST], atol=1e-15)
    t = np.linspace(0, 4, 4001)
    for check in certificate.limits[-2:]:
        order = list(LINEAR).index(check.limit) + 1
        sampled = float(np.max(np.linalg.norm(law.place(t, order), axis=1)))
        assert sampled <= check.upper <= sampled * (1 + 1e-5)
        assert check.unit == ["m/s", "m/s²"][order - 1]


@pytest.mark.parametrize("name", LINEAR)
@pytest.mark.parametrize("by_axis", [False, True])
def test_a_limit_holds_just_above_the_peak_and_not_just_below(name, by_axis):
    wide = {**LIMITS, name: [50.0] * 3 if by_axis else 50.0}
    peaks = [c.upper for c in certify(from_document(moving(limits=wide))).limits if c.limit.startswith(name)]
    for factor, holds in ((1 + 1e-9, True), (1 - 1e-9, False)):
        bounds = [peak * factor for peak in peaks]
        limits = wide | {name: bounds if by_axis else bounds[0]}
        assert certify(from_document(moving(limits=limits))).holds is holds


def test_stretching_time_divides_linear_rates_by_its_powers():
    slow = moving()
    slow["segments"][0] |= {"duration": 8.0}
    slow["segments"][0]["pieces"][0]["duration"] = 8.0
    fast, slow = (certify(from_document(d)).limits[-2:] for d in (moving(), slow | {"duration": 8.0}))
    for power, a, b in zip((1, 2), fast, slow, strict=True):
        assert b.peak * 2**power == pytest.approx(a.peak, rel=1e-12)


@pytest.mark.parametrize("gap", [0.0, 1e-12, 1e-6])
def test_gaps_of_the_way_are_found(gap):
    findings = certify(from_document(two_legs(gap))).findings()
    assert (findings == []) is (gap < 1e-9)
    if findings:
        assert findings[0].startswith("the origin's way has no gap: off by")
        assert "node 2" in findings[0]


def test_jumps_of_linear_rates_are_found_and_no_limit_beyond_them_holds():
    certificate = certify(from_document(moving(points=[FIRST, FIRST, LAST, LAST])))
    assert certificate.translation.order == 1
    assert certificate.continuity.order == 2
    assert certificate.findings() == ["the motion is C1, C2 was asked for"]
    certificate = certify(from_document(moving(points=[FIRST, LAST])))
    (node, _) = certificate.translation.nodes
    speed = np.linalg.norm(np.subtract(LAST, FIRST)) / 4
    assert certificate.order == 0
    assert node.jump[1] > 0.5 * speed
    message = "the origin's velocity jumps at node 1, where a limit on one of its derivatives cannot hold"
    assert message in certificate.findings()


def test_jumps_inside_a_segment_count():
    document = moving()
    (piece,) = document["segments"][0].pop("pieces")
    control = np.array([piece["control"][0]] * 3 + [piece["control"][-1]] * 3)
    middle = (control[0] + control[-1]) / 2
    halves = [
        {
            "duration": 2.0,
            "control": [control[0].tolist()] * 3 + [middle.tolist()] * 3,
            "points": [FIRST] * 6,
        },
        {
            "duration": 2.0,
            "control": [middle.tolist()] * 3 + [control[-1].tolist()] * 3,
            "points": [LAST] * 6,
        },
    ]
    document["segments"][0]["pieces"] = halves
    certificate = certify(from_document(document))
    assert any("the origin's way has no gap" in f for f in certificate.findings())


def test_a_way_where_the_quaternion_vanishes_is_a_finding():
    document = moving()
    document["segments"][0]["pieces"][0]["control"][-1] = [0.0] * 4
    with np.errstate(over="ignore", invalid="ignore"):  # as the command has it
        findings = certify(from_document(document)).findings()
    assert any("the origin's way has no gap" in f or "linear_velocity reaches" in f for f in findings)


def after_another(duration, control, points, jump):
    """There and back, with a jump of acceleration where they meet, after one more leg from `FIRST`."""
    document = two_legs()
    for leg in document["segments"]:
        leg["start_time"] += duration
    document["segments"][1]["pieces"][0]["points"][2] = [x + jump for x in LAST]
    start, end = (np.array(q) / np.linalg.norm(q) for q in (control[0], control[-1]))
    if end @ document["segments"][0]["start"] < 0:
        for leg in document["segments"]:
            leg["start"], leg["end"] = ([-x for x in leg[key]] for key in ("start", "end"))
            leg["pieces"][0]["control"] = [[-x for x in q] for q in leg["pieces"][0]["control"]]
    leg = deepcopy(document["segments"][0]) | {"from": "0", "to": "1", "start_time": 0.0}
    leg |= {"duration": duration, "start": start.tolist(), "end": end.tolist()}
    leg["pieces"] = [{"duration": duration, "control": control, "points": points}]
    limits = {"velocity": 1e9}
    return document | {"segments": [leg, *document["segments"]], "duration": 8.0 + duration, "limits": limits}


def brief(jump):
    """A nanometre in a nanosecond."""
    near = [FIRST[0] + 1e-9, *FIRST[1:]]
    return after_another(1e-9, [[1.0, 0.0, 0.0, 0.0]] * 2, [near] * 3 + [FIRST] * 3, jump)


def spiked(jump):
    """Once round about x where a rule of 16 nodes has one of them, a metre off there: D is nearly zero."""
    u, n, least = float(np.polynomial.legendre.leggauss(16)[0][8] + 1) / 2, 10, 1e-4
    weights = [comb(n, i) * u**i * (1 - u) ** (n - i) for i in range(n + 1)]
    control = [[w, 0.0, 0.0, 0.0] for w in (1.0, 1.0, 1.0, 1.0, 0.5, 0.0, -0.5, -1.0, -1.0, -1.0, -1.0)]
    rest = sum(w * q[0] for w, q in zip(weights, control, strict=True))
    control[5] = [-rest / weights[5], least / weights[5], 0.0, 0.0]
    squares = [np.zeros(2 * n + 1), np.zeros(2 * n + 1)]
    for i in range(n + 1):
        for j in range(n + 1):
            part = comb(n, i) * comb(n, j) / comb(2 * n, i + j)
            for square, k in zip(squares, (0, 1), strict=True):
                square[i + j] += part * control[i][k] * control[j][k]
    points = np.outer(squares[0] + squares[1], FIRST) + np.outer(squares[1], [1.0, 0.0, 0.0])
    return after_another(1.0, control, points.tolist(), jump)


@pytest.mark.parametrize("made", [brief, spiked])
@pytest.mark.parametrize(("jump", "holds"), [(0.0, True), (1e-3, False)])
def test_nothing_brief_hides_a_jump_of_the_way(made, jump, holds):
    assert certify(from_document(made(jump))).findings() == (
        [] if holds else ["the motion is C1, C2 was asked for"]
    )


@pytest.mark.parametrize(("by", "holds"), [(0.0, True), (1e-6, False)])
def test_the_way_of_a_motion_that_goes_round_closes(by, holds):
    """The other end is what comes before the start; a motion that starts at speed there may end at it."""
    document = two_legs() | {"periodic": True}
    last = document["segments"][1]["pieces"][0]
    last["points"][3:] = [[x + by for x in FIRST]] * 3
    findings = certify(from_document(document)).findings()
    assert (findings == []) is holds
    for leg, index, sense in ((0, 1, 1), (1, 4, -1)):
        points = document["segments"][leg]["pieces"][0]["points"]
        points[index] = [x + sense * 0.01 for x in points[index]]
        points[index + sense] = [x + sense * 0.02 for x in points[index + sense]]
    found = certify(from_document(document))
    assert (found.findings() == []) is holds
    assert found.translation.nodes[0].jump[1] < 1e-12
    document["periodic"] = False
    assert certify(from_document(document)).translation.order == 0


def test_a_body_that_only_turns_about_a_point_far_away_has_no_jumps():
    document = moving()
    square = np.array([1.0])
    control = np.array(document["segments"][0]["pieces"][0]["control"])
    for column in control.T:  # |Q|², by products of polynomials
        power = np.polynomial.Polynomial([0.0])
        for i, c in enumerate(column):
            power += (
                c
                * comb(5, i)
                * np.polynomial.Polynomial([0, 1]) ** i
                * np.polynomial.Polynomial([1, -1]) ** (5 - i)
            )
        square = np.polynomial.polynomial.polyadd(square, (power**2).coef)
    square[0] -= 1.0
    n = 10
    points = [sum(comb(j, i) / comb(n, i) * square[i] for i in range(j + 1)) for j in range(n + 1)]
    document["segments"][0]["pieces"][0]["points"] = [[1e3 * p, 0.0, 2e3 * p] for p in points]
    certificate = certify(from_document(document))
    assert certificate.findings() == []
    assert certificate.limits[-2].upper < 1e-8


def arc():
    return {
        "kind": "arc",
        "from": "2",
        "to": "3",
        "start_time": 4.0,
        "duration": 1.0,
        "start": [0.8, 0.36, 0.48, 0.0],
        "end": [0.8, 0.36, 0.48, 0.0],
        "axis": [1.0, 0.0, 0.0],
        "angle": 0.1,
        "pieces": [{"duration": 1.0, "state": [0.0, 0.0, 0.0], "bernstein": [6.0, -12.0, 6.0]}],
    }


def dwell(**more):
    return {
        "kind": "dwell",
        "at": "2",
        "start_time": 4.0,
        "duration": 1.0,
        "orientation": [0.8, 0.36, 0.48, 0.0],
    } | more


def without_points():
    document = moving()
    document["segments"][0]["pieces"][0].pop("points")
    return document


def with_segment(segment):
    document = moving()
    document["segments"].append(segment)
    return document


def with_piece(**changes):
    document = moving()
    document["segments"][0]["pieces"][0] |= changes
    return document


REFUSED = {
    "a linear limit on a body that turns": (without_points, 'limits: a limit on the linear_velocity needs a translation: "points" in the pieces of every segment'),
    "an arc among them": (partial(with_segment, arc()), 'segments[1]: the body\'s origin moves in other segments; "points" is needed here too'),
    "a dwell nowhere": (partial(with_segment, dwell()), 'segments[1]: the body\'s origin moves in other segments; "point" is needed here too'),
    "two coordinates": (partial(with_piece, points=[[1.0, 2.0]]), "segments[0].pieces[0].points[0]: List should have at least 3 items after validation, not 2"),
    "no points": (partial(with_piece, points=[]), "segments[0].pieces[0].points: List should have at least 1 item after validation, not 0"),
    "too many": (partial(with_piece, points=[FIRST] * 201), "segments[0].pieces[0].points: List should have at most 200 items after validation, not 201"),
    "too far": (partial(with_piece, points=[[1e13, 0.0, 0.0]]), "segments[0].pieces[0].points[0][0]: Input should be less than or equal to 1000000000000"),
    "an edge of nothing": (partial(moving, body={"shape": [1.0, 0.0, 1.0]}), "body.shape[1]: Input should be greater than or equal to 0.000000001"),
    "a body of nothing": (partial(moving, body={}), "body: Value error, an inertia or a shape is needed"),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused(case):
    make, message = REFUSED[case]
    with pytest.raises(InputError) as error:
        from_document(make())
    assert str(error.value) == message


def test_points_belong_to_all_pieces_or_none():
    document = moving()
    (piece,) = document["segments"][0]["pieces"]
    document["segments"][0]["pieces"] = [piece, {k: v for k, v in piece.items() if k != "points"}]
    with pytest.raises(InputError, match="points belong to all pieces of a segment, or to none"):
        from_document(document)


def test_a_dwell_keeps_the_origin_where_it_is():
    law = from_document(with_segment(dwell(point=LAST)) | {"duration": 5.0})
    assert certify(law).findings() == []
    np.testing.assert_array_equal(law.place([4.2, 5.0]), [LAST, LAST])
    assert to_document(law)["segments"][1]["point"] == LAST
    astray = from_document(with_segment(dwell(point=FIRST)) | {"duration": 5.0})
    assert any("the origin's way has no gap" in f for f in certify(astray).findings())


def test_the_record_of_the_way_is_compared():
    law = from_document(two_legs())
    document = json.loads(format_law(law, certify(law), {}))
    certificate = certify(from_document(document))
    assert compare_with_record(certificate, document) == []
    document["certificate"]["translation"]["nodes"][0]["jump"]["jerk"] *= 1.001
    message = 'the recorded certificate says otherwise about "translation"'
    assert compare_with_record(certificate, document) == [message]
    document["segments"][0]["pieces"][0]["points"][3][0] += 1e-9
    assert "the motion was altered after it was certified: its digest is another" in compare_with_record(
        certify(from_document(document)), document
    )


def test_samples_have_place_and_velocity_after_the_rest():
    law = from_document(moving())
    header, *rows = "".join(format_samples(law, 10.0)).splitlines()
    assert header.endswith("jx,jy,jz,x,y,z,vx,vy,vz,segment,node")
    table = np.array([[float(cell) for cell in row.split(",")[:20]] for row in rows])
    np.testing.assert_allclose(table[:, 14:17], law.place(table[:, 0]), atol=1e-12)
    np.testing.assert_allclose(table[:, 17:20], law.place(table[:, 0], 1), atol=1e-12)
    assert (
        "".join(format_samples(from_document(make_law()), 10.0))
        .splitlines()[0]
        .endswith("jx,jy,jz,segment,node")
    )


def test_a_motion_without_a_translation_has_no_place():
    with pytest.raises(ValueError, match="no translation"):
        from_document(make_law()).place(1.0)
