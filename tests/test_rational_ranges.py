"""Rational segments at the ends of their range, and beside arcs: scales, short pieces, Q near zero."""

import numpy as np
import pytest

from tests.test_rational import WHEELS, make_law
from timelaw.certificate import certify
from timelaw.law_file import from_document


@pytest.mark.parametrize(
    ("duration", "factor"), [(1e-30, 1e6), (1e-28, 1.0), (1e-9, 1e-30), (1e12, 1e6), (1.0, 1e-200)]
)
def test_bounds_scale_with_time_and_not_with_the_size_of_q(duration, factor):
    """Powers of short times and small Q once left the range of doubles, and what was no number was passed over."""
    law = make_law(limits={"snap": 1.0, "jerk": [1.0] * 3})
    shortest = max(duration, 1e-9)
    law["segments"][0] |= {"duration": shortest, "start": [0.6, 0.0, 0.8, 0.0], "end": [0.0, 0.6, 0.8, 0.0]}
    control = [[0.6, 0.0, 0.8, 0.0], [0.5, 0.2, 0.9, 0.1], [0.1, 0.4, 0.8, 0.3], [0.0, 0.6, 0.8, 0.0]]

    def bounds(duration, factor):
        piece = {"duration": duration, "control": [[x * factor for x in q] for q in control]}
        law["segments"][0]["pieces"] = [piece]
        return {c.limit: c.upper for c in certify(from_document(law)).limits}

    plain = bounds(1.0, 1.0)
    for name, upper in bounds(duration, factor).items():
        assert upper == pytest.approx(plain[name] / duration ** (4 if name == "snap" else 3), rel=1e-9)


def test_a_last_piece_that_no_time_resolves_is_where_the_motion_ends():
    law = make_law()
    control = [[0.8, 0.36, 0.48, 0.0], [0.8, 0.36, 0.48, 1e-25]]
    law["segments"][0]["pieces"].append({"duration": 1e-25, "control": control})
    read = from_document(law)
    np.testing.assert_allclose(read(4.0), control[1], rtol=1e-15)
    np.testing.assert_allclose(read(4.0, 1), [-0.96, 0.72, 1.6], rtol=1e-14)


@pytest.mark.parametrize(("nearest", "bounded"), [(1e-2, True), (1e-5, True), (1e-13, False)])
def test_a_curve_near_zero_is_bounded_where_it_can_be_told_from_zero(nearest, bounded):
    """Near it Q is (1 - 2u, nearest, 0, 0): ω = 2 · 2 nearest/h over (1 - 2u)² + nearest², which is 4/(h nearest)."""
    law = make_law(limits={"velocity": 1.0, "snap": 1.0})
    control = [[1 - 2 * i / 6, nearest, 0.0, 0.0] for i in range(7)]
    law["segments"][0]["pieces"][0]["control"] = control
    velocity, snap = certify(from_document(law)).limits
    assert (velocity.upper == pytest.approx(4 / 4.0 / nearest, rel=1e-8)) is bounded
    assert np.isfinite(snap.upper) == bounded


@pytest.mark.parametrize(
    "limits", [{"velocity": 1.1, "jerk": [30.0] * 3}, {"torque": 70.0, "momentum": 30.3}]
)
def test_arcs_and_rational_segments_have_their_limits_together(limits):
    """One check for each limit, whatever power of it each kind of segment is judged by."""
    law = make_law(limits=limits) | {"body": WHEELS, "duration": 7.0, "continuity": 2}
    go = law["segments"][0]
    turn = [60 / 3.0**3 * c for c in (1.0, -2.0, 1.0)]
    arc = {"kind": "arc", "from": "0", "to": "1", "start_time": 0.0, "duration": 3.0, "axis": [1.0, 0.0, 0.0]}
    arc |= {"start": [np.cos(0.5), -np.sin(0.5), 0.0, 0.0], "end": go["start"], "angle": 1.0}
    arc["pieces"] = [{"duration": 3.0, "state": [0.0, 0.0, 0.0], "bernstein": turn}]
    law["segments"] = [arc, go | {"start_time": 3.0}]
    certificate = certify(from_document(law))
    assert certificate.findings() == []
    names = [check.limit for check in certificate.limits]
    assert sorted(set(names)) == sorted(names)
    for check in certificate.limits:
        assert check.bound == pytest.approx(np.max(limits[check.limit.split()[0]]), rel=1e-14)
        assert bool(check.note) is (check.limit in ("torque", "momentum"))


@pytest.mark.parametrize("point", [[0.0] * 4, [5e-324] * 4, [1e-170, 0.0, 0.0, 0.0]])
@pytest.mark.parametrize("index", [0, -1])
def test_ends_at_which_q_vanishes_are_findings(point, index):
    law = make_law()
    law["segments"][0]["pieces"][0]["control"][index] = point
    assert certify(from_document(law)).findings() != []
